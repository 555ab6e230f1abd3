// YU: "Electric Logistics Vehicle Path Planning Based on the Fusion of the Improved A-Star Algorithm and Dynamic Window
// Approach".
#include "tools/lab/papers/published_table.hpp"

namespace aisle::lab {
namespace {

using local_planner::clearance_critic;
using local_planner::heading_critic;
using local_planner::velocity_critic;

constexpr double kDegrees = 180.0 / geometry::kPi;
constexpr const char* kCheng =
    "Cheng 2017 (J. Xi'an Jiaotong Univ. 51, in Chinese): YU prints its results and no formula of it";
constexpr const char* kWu2020 = "Wu 2020: YU prints its results and no formula of it";
constexpr const char* kRviz = "of a simulation in ROS and Gazebo whose world is not published";

void append_scene(std::vector<PublishedRow>& rows, const char* table, const char* map,
                  const std::vector<std::vector<double>>& figures, const char* length_note = "") {
  append(rows, PlanTable{table,
                         "",
                         map,
                         {{"turning points number", PlanFigure::kTurns},
                          {"number of nodes traversed", PlanFigure::kExpanded},
                          {"path length, m", PlanFigure::kLength},
                          {"search time", PlanFigure::kTime}},
                         {{"A* algorithm using Euclidean distance", "traditional", figures[0]},
                          {"Cheng 2017 proposed improvements to A*", nullptr, figures[1], kCheng},
                          {"A* algorithm with improved heuristic function", "yu-without-passes", figures[2]},
                          {"A* algorithm with improved heuristic function and optimized folds", "yu", figures[3]}},
                         {"", "", length_note}});
}

void append_percents(std::vector<PublishedRow>& rows) {
  const auto percent = [&](const char* row, const char* published, const char* map, PlanFigure figure,
                           const char* note = "") {
    append_claim(rows, "YU section 4", row, published, ClaimedDirection::kMore,
                 PlanEvidence{map, "yu", "traditional", figure, true}, note);
  };
  percent("scene 1: fewer turning points", "20 %", "yu-1", PlanFigure::kTurns);
  percent("scene 1: fewer traversed nodes", "18.51 %", "yu-1", PlanFigure::kExpanded);
  percent("scene 1: shorter path", "8.99 %", "yu-1", PlanFigure::kLength,
          "follows from the text's 24.5729 m; table 2's 24.8729 m gives 7.89 %");
  percent("scene 1: less search time", "16.27 %", "yu-1", PlanFigure::kTime, "the abstract prints 16.26 %");
  percent("scene 2: fewer turning points", "77.78 %", "yu-2", PlanFigure::kTurns);
  percent("scene 2: fewer traversed nodes", "17.86 %", "yu-2", PlanFigure::kExpanded);
  append_claim(rows, "YU section 4", "scene 2: longer path, since it keeps off the corners", "4.11 %",
               ClaimedDirection::kLess, PlanEvidence{"yu-2", "yu", "traditional", PlanFigure::kLength, true},
               "ours as a reduction: a negative figure is longer");
  percent("scene 2: less search time", "21.58 %", "yu-2", PlanFigure::kTime);
  percent("50 x 50: fewer turning points", "38.46 %", "yu-3", PlanFigure::kTurns);
  percent("50 x 50: fewer traversed nodes", "74.27 %", "yu-3", PlanFigure::kExpanded);
  percent("50 x 50: shorter path", "3.58 %", "yu-3", PlanFigure::kLength);
  percent("50 x 50: less search time", "75.88 %", "yu-3", PlanFigure::kTime);
}

void append_drives(std::vector<PublishedRow>& rows, const char* table, const char* scene,
                   const std::vector<std::vector<double>>& figures, const char* note) {
  append(rows, DriveTable{table,
                          scene,
                          {{"path length, m", DriveFigure::kLength}, {"search time, s", DriveFigure::kTime}},
                          {{"Dynamic Window Approach", "dwa-own", figures[0]},
                           {"A* Algorithm Fusion DWA", "astar-own", figures[1]},
                           {"Improved A* Fusion DWA proposed by Wu 2020", nullptr, figures[2], kWu2020},
                           {"In this paper, we improve the A* algorithm to fuse DWA", "improved", figures[3]}},
                          {note, "the time that the drive takes; YU's weights of table 1 in every row"}});
}

void append_fused(std::vector<PublishedRow>& rows) {
  append_drives(rows, "YU 5", "yu-5",
                {{27.0026, 79.904031}, {27.9319, 85.142965}, {26.0413, 77.020405}, {24.5729, 66.907335}},
                "the table repeats table 2 number by number, but for one digit");
  append_drives(rows, "YU 6", "yu-6",
                {{28.4446, 79.300621}, {25.4588, 94.402967}, {26.3942, 88.878559}, {24.6606, 66.881723}}, "");
  const auto percent = [&](const char* row, const char* published, const char* scene, const char* reference,
                           DriveFigure figure, const char* note = "") {
    append_claim(rows, "YU section 4", row, published, ClaimedDirection::kMore,
                 DriveEvidence{scene, "improved", reference, figure, true}, note);
  };
  percent("static fusion: shorter than the DWA", "8.99 %", "yu-5", "dwa-own", DriveFigure::kLength);
  percent("static fusion: less time than the DWA", "16.27 %", "yu-5", "dwa-own", DriveFigure::kTime,
          "the conclusion prints 16.26 %");
  percent("dynamic fusion: shorter than the DWA", "13.30 %", "yu-6", "dwa-own", DriveFigure::kLength);
  percent("dynamic fusion: less time than the DWA", "15.66 %", "yu-6", "dwa-own", DriveFigure::kTime);
  append_claim(rows, "YU section 5", "conclusion: shorter than the A* algorithm", "4.56 %", ClaimedDirection::kMore,
               DriveEvidence{"yu-5", "improved", "traditional-plan", DriveFigure::kLength, true},
               "follows from no pair of its tables");
  append_claim(rows, "YU figure 6", "the shortest path of all, static and dynamic obstacles", "shortest",
               ClaimedDirection::kLess, DriveEvidence{"yu-6", "improved", "astar-own", DriveFigure::kLength},
               "against A* fused with the same DWA");
  append_claim(rows, "YU figure 6", "the smoothest path of all, static and dynamic obstacles", "smoothest",
               ClaimedDirection::kLess, DriveEvidence{"yu-6", "improved", "astar-own", DriveFigure::kSharpTurns},
               "by sharp turns of the driven way, against A* fused with the same DWA");
  append_claim(rows, "YU figure 7a", "angular velocity converges fastest and is the most stable", "soonest steady",
               ClaimedDirection::kLess, DriveEvidence{"yu-6", "improved", "astar-own", DriveFigure::kChangesOfW});
  append_claim(rows, "YU figure 7b", "linear velocity converges fastest", "soonest steady", ClaimedDirection::kLess,
               DriveEvidence{"yu-6", "improved", "astar-own", DriveFigure::kChangesOfV});
  append_claim(rows, "YU figure 7c", "a smooth attitude angle that reaches the target faster", "sooner",
               ClaimedDirection::kLess, DriveEvidence{"yu-6", "improved", "astar-own", DriveFigure::kTime});
}

}  // namespace

void append_yu(std::vector<PublishedRow>& rows) {
  const local_planner::PaperLimits limits = limits_of("yu");
  append_settings(
      rows, "YU 1",
      {{"Maximum speed, m/s", 2, limits.max_speed_mps},
       {"Maximum rotation speed, rad/s", 20, limits.max_turn_radps * kDegrees, "degrees, printed as radians"},
       {"Maximum rotational acceleration, rad/s2", 50, limits.max_turn_acceleration_radps2 * kDegrees,
        "degrees, printed as radians"},
       {"Time to simulate trajectory forward, s", 3, limits.horizon_s},
       {"Weighting of heading scores", 0.05, weight_of("yu", heading_critic)},
       {"Distance score weighting", 0.2, weight_of("yu", clearance_critic)},
       {"Speed score weighting", 0.5, weight_of("yu", velocity_critic)}});
  append_scene(rows, "YU 2", "yu-1",
               {{5, 108, 27.0026, 79.904031},
                {8, 247, 27.9319, 85.142965},
                {5, 172, 26.0413, 77.020405},
                {4, 88, 24.8729, 66.907335}},
               "the text prints 24.5729 m for the last row");
  append_scene(
      rows, "YU 3", "yu-2",
      {{9, 112, 23.3848, 61.042}, {5, 201, 22.6624, 109.136}, {5, 95, 25.7279, 48.357}, {2, 92, 24.3454, 47.867}});
  append_scene(rows, "YU 4", "yu-3",
               {{13, 820, 62.2548, 491.858},
                {12, 1976, 59.9827, 1367.009},
                {14, 225, 64.0122, 118.024},
                {8, 211, 60.0237, 118.618}});
  append_percents(rows);
  append_fused(rows);
  append_claim(rows, "YU 7", "Initial position", "(-1.95, -1.95, 0)", ClaimedDirection::kEqual, NoEvidence{kRviz});
  append_claim(rows, "YU 7", "Initial target point", "(13.5, 16.5, 90)", ClaimedDirection::kEqual, NoEvidence{kRviz});
  append_claim(rows, "YU 7", "Straight line width", "0.05", ClaimedDirection::kEqual, NoEvidence{kRviz});
  append_claim(rows, "YU figure 8", "fewer turning points than A*, smoother paths when fused", "fewer",
               ClaimedDirection::kLess, NoEvidence{kRviz});
  append_claim(rows, "YU figure 9", "smoother local path on a SLAM map", "smoother", ClaimedDirection::kLess,
               NoEvidence{kRviz});
}

}  // namespace aisle::lab
