#include "tools/draw/svg.hpp"

#include <gmock/gmock.h>

#include "tools/draw/colours.hpp"
#include "tools/draw/legend.hpp"

namespace aisle::draw {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Svg, WritesWholePixelsAsTheyAreAndOthersToATenth) {
  EXPECT_EQ(Px(60).text(), "60");
  EXPECT_EQ(Px(60.0).text(), "60.0");
  EXPECT_EQ(Px(0.24).text(), "0.2");
  EXPECT_EQ((Px(1) + Px(2)).text(), "3");
  EXPECT_EQ((Px(1) + Px(2.0)).text(), "3.0");
}

TEST(Svg, EscapesWordsButNotAttributes) {
  EXPECT_EQ(text(1, 2, "font-size=\"11\"", "a < \"b\" & c\x07"),
            "<text x=\"1\" y=\"2\" font-size=\"11\">a &lt; &quot;b&quot; &amp; c </text>");
  EXPECT_THAT(path("M0 0h1", "", "<b>"), HasSubstr("<title>&lt;b&gt;</title>"));
}

TEST(Svg, HasNoBlankForAttributesThatAreNotThere) {
  EXPECT_EQ(rect(1, 2, 3, 4, ""), "<rect x=\"1\" y=\"2\" width=\"3\" height=\"4\"/>");
  EXPECT_EQ(circle(1, 2.0, 3, "fill=\"red\""), "<circle cx=\"1\" cy=\"2.0\" r=\"3\" fill=\"red\"/>");
}

TEST(Svg, FollowsPointsAsPathAndAsPolyline) {
  const std::vector<PointPx> points{{0.0, 1.0}, {2.04, 3.06}};
  EXPECT_EQ(path_along(points), "M0.0 1.0L2.0 3.1");
  EXPECT_EQ(polyline(points, ""), "<polyline points=\"0.0,1.0 2.0,3.1 \"/>");
  EXPECT_EQ(path_along({}), "");
}

TEST(Svg, ADocumentHasASizeUnlessItFillsWhatShowsIt) {
  Page page{300, 200, "font-size=\"12\""};
  EXPECT_EQ(document(page, "<g/>\n"),
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"300\" height=\"200\" viewBox=\"0 0 300 200\" "
            "font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#f5f7fa\"/>\n<g/>\n</svg>\n");
  page.fills_container = true;
  EXPECT_THAT(document(page, ""), Not(HasSubstr("width=\"300\"")));
}

TEST(Legend, PutsEntriesBesideEachOther) {
  Legend legend(10, 20, 34, "fill=\"red\"");
  legend.add("<rect/>", "a & b", 100);
  legend.add("<circle/>", "c", 50);
  EXPECT_EQ(legend.svg(),
            "<g transform=\"translate(10 20)\"><rect/><text x=\"34\" y=\"4\" fill=\"red\">a &amp; b</text></g>\n"
            "<g transform=\"translate(110 20)\"><circle/><text x=\"34\" y=\"4\" fill=\"red\">c</text></g>\n");
}

TEST(Colours, RepeatAfterThoseThatAreWanted) {
  EXPECT_EQ(colour(0), colour(10));
  EXPECT_EQ(colour(0, 8), colour(8, 8));
  EXPECT_STRNE(colour(8), colour(0));
}

}  // namespace
}  // namespace aisle::draw
