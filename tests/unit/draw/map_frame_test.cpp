#include "tools/draw/map_frame.hpp"

#include <gtest/gtest.h>

namespace aisle::draw {
namespace {

TEST(MapFrame, TurnsMetresUpwardsIntoPixelsDownwards) {
  const MapFrame frame = frame_of({40, 20, 0.5, {-5.0, 3.0}}, 10.0, 30.0);
  EXPECT_DOUBLE_EQ(frame.width_px(), 200.0);
  EXPECT_DOUBLE_EQ(frame.height_px(), 100.0);
  EXPECT_DOUBLE_EQ(frame.at({-5.0, 3.0}).x, 0.0);
  EXPECT_DOUBLE_EQ(frame.at({-5.0, 3.0}).y, 130.0);
  EXPECT_DOUBLE_EQ(frame.at({15.0, 13.0}).x, 200.0);
  EXPECT_DOUBLE_EQ(frame.at({15.0, 13.0}).y, 30.0);
}

TEST(MapFrame, FitsTheLongerEdge) {
  EXPECT_DOUBLE_EQ(fitted_frame({40, 20, 0.5, {}}, 800.0).width_px(), 800.0);
  EXPECT_DOUBLE_EQ(fitted_frame({20, 40, 0.5, {}}, 800.0).height_px(), 800.0);
}

TEST(MapFrame, LeavesOutCornersThatAreTooNearToSeeButNotTheLast) {
  const MapFrame frame = frame_of({10, 10, 1.0, {}}, 10.0);
  EXPECT_EQ(path_along(frame, {{0.0, 10.0}, {0.01, 10.0}, {5.0, 10.0}, {5.01, 10.0}}), "M0.0 0.0L50.0 0.0L50.1 0.0");
}

TEST(MapFrame, DrawsDiscsAndTurnedRectanglesToScale) {
  const MapFrame frame = frame_of({10, 10, 1.0, {}}, 10.0);
  EXPECT_EQ(disc(frame, {5.0, 5.0}, 0.5, ""), "<circle cx=\"50.0\" cy=\"50.0\" r=\"5.0\"/>");
  EXPECT_EQ(turned_rect(frame, {5.0, 5.0, 0.5 * geometry::kPi}, 4.0, 2.0, ""),
            "<path d=\"M40.0 30.0L40.0 70.0L60.0 70.0L60.0 30.0z\"/>");
  EXPECT_EQ(scale_bar(frame, 10.0, 20.0, 2.0, ""), "<path d=\"M10.0 20.0v6h20.0v-6\"/>");
}

}  // namespace
}  // namespace aisle::draw
