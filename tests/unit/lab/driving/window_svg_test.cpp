#include "tools/lab/driving/window_svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/sim/scenarios/building.hpp"

namespace aisle::lab {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

WindowScene crossing() {
  WindowScene scene;
  scene.title = "somebody crosses";
  scene.start_in_map = {2.0, 5.0};
  scene.goal_in_map = {18.0, 5.0};
  for (int i = 0; i <= 60; ++i) {
    scene.driven_in_map.push_back({2.0 + 0.1 * i, 5.0});
    scene.mover_in_map.push_back({8.0, 1.0 + 0.1 * i});
  }
  return scene;
}

TEST(WindowSvg, SaysWhoWasWhereAndWhen) {
  const std::string svg = window_svg(sim::hall(20.0, 10.0, 0.1), crossing());
  for (const char* text : {"somebody crosses", "start", "goal", ">0 s<", ">2 s<", ">4 s<", ">6 s<", ">2 m<",
                           "vehicle, every 2 s", "mover, every 2 s"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(
      svg,
      HasSubstr("nearest: 0.81 m between the outlines, at 5.0 s"));  // sqrt(2) m from (7, 5) to (8, 6), less both radii
  EXPECT_THAT(svg, Not(HasSubstr("box")));
  EXPECT_THAT(svg, Not(HasSubstr("sub-target")));
}

TEST(WindowSvg, ShowsWhereItAimedBesideThePath) {
  WindowScene scene = crossing();
  const std::string without = window_svg(sim::hall(20.0, 10.0, 0.1), scene);
  scene.sub_targets = {{{4.0, 5.0}, {9.0, 3.0}}};
  const std::string svg = window_svg(sim::hall(20.0, 10.0, 0.1), scene);
  EXPECT_THAT(svg, HasSubstr("local sub-target"));
  EXPECT_GT(svg.size(), without.size() + 200);
}

TEST(WindowSvg, AVehicleThatStandsIsDrawnOnce) {
  WindowScene scene = crossing();
  scene.mover_in_map.clear();
  for (geometry::Point2& p : scene.driven_in_map) p = scene.start_in_map;
  scene.boxes.push_back({{9.0, 4.0}, {10.0, 6.0}});
  const std::string svg = window_svg(sim::hall(20.0, 10.0, 0.1), scene);
  EXPECT_THAT(svg, HasSubstr(">0 s<"));
  EXPECT_THAT(svg, Not(HasSubstr(">2 s<")));
  EXPECT_THAT(svg, HasSubstr("box, not in the map"));
  EXPECT_THAT(svg, Not(HasSubstr("nearest")));
}

}  // namespace
}  // namespace aisle::lab
