#include "tools/lab/driving/ways_svg.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/places.hpp"

namespace aisle::lab {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(WaysSvg, ShowsEveryContestantsWayPastMoversAndBoxes) {
  const DrawnMap map = read_drawn_map(test_support::source_folder() / "deploy/experiments/qu-simple.txt", 1.0);
  const Encounters there = encounters_of_paper("qu-simple", map, {2, 1}, 2.0);
  const std::string svg = ways_svg(
      "QU 3", map, there,
      {{"improved", {{5.5, 16.5}, {9.0, 12.0}, {19.5, 3.5}}}, {"A*", {{5.5, 16.5}, {19.5, 3.5}}}, {"never drove", {}}});
  EXPECT_EQ(svg.rfind("<svg", 0), 0U);
  for (const char* name : {">QU 3<", ">improved<", ">A*<", ">never drove<", ">S<", ">T<"})
    EXPECT_NE(svg.find(name), std::string::npos) << name;
  EXPECT_EQ(count(svg, "stroke-dasharray"), 2U) << "one dashed way a mover";
  EXPECT_EQ(count(svg, "fill-opacity=\"0.35\""), 4U) << "a disc at each end";
}

}  // namespace
}  // namespace aisle::lab
