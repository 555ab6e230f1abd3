#include "tools/cli/text.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace aisle::cli {
namespace {

using Tree = nlohmann::ordered_json;

TEST(Text, OfASampleIsOneLineAField) {
  const Tree sample{{"agv_id", "agv-1"},
                    {"pose", {{"x_m", 1.5}, {"y_m", -2.0}}},
                    {"held", false},
                    {"detail", ""},
                    {"n", 18446744073709551615u}};
  EXPECT_EQ(text_of_sample(sample, Length::kShort),
            "agv_id: agv-1\npose: {x_m: 1.5, y_m: -2}\nheld: false\ndetail: \"\"\nn: 18446744073709551615\n");
}

TEST(Text, OfALongListIsCutUnlessAskedForInFull) {
  Tree sample;
  for (int i = 0; i < 360; ++i) sample["ranges_m"].push_back(i);
  EXPECT_EQ(text_of_sample(sample, Length::kShort), "ranges_m: [0, 1, 2, 3, 4, 5, 6, 7, ... 360 in all]\n");
  EXPECT_NE(text_of_sample(sample, Length::kFull).find("358, 359]"), std::string::npos);
}

TEST(Text, OfAListOfStructuresIsOneLineEach) {
  Tree sample;
  for (int i = 0; i < 9; ++i) sample["points"].push_back({{"x_m", 1000.125 + i}, {"y_m", 2000.5}, {"label", "corner"}});
  const std::string text = text_of_sample(sample, Length::kShort);
  EXPECT_EQ(text.substr(0, 62), "points:\n  - {x_m: 1000.125, y_m: 2000.5, label: corner}\n  - {x");
  EXPECT_NE(text.find("\n  ... 9 in all\n"), std::string::npos);
}

TEST(Text, FromTheWireCannotSteerTheTerminal) {
  const Tree sample{{"detail", "a\x1b[2Jb\nc"}};
  EXPECT_EQ(text_of_sample(sample, Length::kShort), "detail: a\\x1b[2Jb\\x0ac\n");
}

TEST(Text, OfATableAlignsColumns) {
  EXPECT_EQ(text_of_table({{"A", "LONG"}, {"abc", "1"}, {"x"}}), "A    LONG\nabc  1\nx\n");
}

TEST(Text, OfAPictureIsDrawnRowByRow) {
  const Tree sample{{"cells", 2}, {"picture", Tree::array({"#.", " +"})}};
  EXPECT_EQ(text_of_sample(sample, Length::kShort), "cells: 2\npicture:\n  |#.|\n  | +|\n");
}

}  // namespace
}  // namespace aisle::cli
