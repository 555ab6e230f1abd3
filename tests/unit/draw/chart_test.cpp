#include "tools/draw/chart.hpp"

#include <gtest/gtest.h>

namespace aisle::draw {
namespace {

const Chart kChart{60, 70, 800, 100, 40.0, -1.0, 1.0};

TEST(Chart, StepsAreOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(round_step(1.2, 6), 0.2);
  EXPECT_DOUBLE_EQ(round_step(24.0, 12), 2.0);
  EXPECT_DOUBLE_EQ(round_step(24.1, 12), 5.0);
  EXPECT_DOUBLE_EQ(round_step(61.0, 12), 10.0);
}

TEST(Chart, DrawsAtTheEdgeWhatLiesBeyond) {
  EXPECT_DOUBLE_EQ(kChart.x(20.0), 460.0);
  EXPECT_DOUBLE_EQ(kChart.x(50.0), 860.0);
  EXPECT_DOUBLE_EQ(kChart.y(0.0), 120.0);
  EXPECT_DOUBLE_EQ(kChart.y(1.5), 70.0);
  EXPECT_DOUBLE_EQ(kChart.y(-1.5), 170.0);
}

TEST(Chart, CurvesGoThroughTheirSamples) {
  EXPECT_EQ(curve(kChart, {{0.0, 0.0}, {20.0, 1.0}}), "M60.0 120.0L460.0 70.0");
}

TEST(Chart, AValueStandsBesideItsLine) {
  EXPECT_EQ(value_line(kChart, 0.5, "red", "text-anchor=\"end\""),
            "<path d=\"M60 95.0H860\" stroke=\"red\"/><text x=\"54\" y=\"99.0\" text-anchor=\"end\">0.5</text>");
}

}  // namespace
}  // namespace aisle::draw
