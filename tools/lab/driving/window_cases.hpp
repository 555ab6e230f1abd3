#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"
#include "tools/lab/driving/window_svg.hpp"
#include "tools/lab/page/progress.hpp"
#include "tools/sim/result.hpp"
#include "tools/sim/setup.hpp"

namespace aisle::lab {

/// One of the situations of WU's rolling window, in a hall of 20 x 10 m, planner `wu`.
struct WindowCase {
  std::string name;  // of the picture's file
  std::string title;
  sim::Setup setup;
};
/// A crosser that passes ahead, one that passes behind, one on collision course, an oncoming one, an unknown box, a
/// closed aisle.
std::vector<WindowCase> window_cases();

struct WindowDrive {
  sim::Result result;
  std::vector<geometry::Point2> driven_in_map;
  std::vector<geometry::Point2> mover_in_map;
  std::vector<WindowScene::Aimed> sub_targets;  // where it aimed instead of along the path
  double sub_target_s{0.0};                     // for how long
  double farthest_off_m{0.0};                   // from the straight line to the goal
  double back_on_it_m{0.0};                     // how far off it is where it ends
  double slowest_mps{1e9};                      // between the first and the last 3 m
  bool asked_for_a_plan{false};                 // was blocked
};
WindowDrive drive_window_case(const WindowCase& of);

/// Markdown of all cases.
struct WindowTable {
  std::string rows;
  std::string pictures;  // links
};
/// Drives all of them; a picture of each is written into `pictures`.
WindowTable window_table(const std::filesystem::path& pictures, const std::string& pictures_from_page,
                         const Progress& progress);

}  // namespace aisle::lab
