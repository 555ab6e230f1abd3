// WU: "Dynamic Path Planning for Forklift AGV Based on Smoothing A* and Improved DWA Hybrid Algorithm".
#include "tools/lab/papers/published_table.hpp"

namespace aisle::lab {
namespace {

using local_planner::clearance_critic;
using local_planner::heading_critic;
using local_planner::path_distance_critic;
using local_planner::sub_target_distance_critic;
using local_planner::velocity_critic;

constexpr const char* kScene = "wu-9-11";  // one unknown box on the way

void append_settings_of_wu(std::vector<PublishedRow>& rows) {
  append_settings(rows, "WU section 6.1",
                  {{"traditional: alpha, heading", 0.2, weight_of("dwa", heading_critic)},
                   {"traditional: beta, velocity", 0.3, weight_of("dwa", velocity_critic)},
                   {"traditional: gamma, distance", 0.5, weight_of("dwa", clearance_critic)},
                   {"improved: alpha, heading", 0.2, weight_of("wu", heading_critic)},
                   {"improved: beta, velocity", 0.3, weight_of("wu", velocity_critic)},
                   {"improved: gamma, distance", 0.15, weight_of("wu", clearance_critic)},
                   {"improved: eta, dist-1", 0.2, weight_of("wu", path_distance_critic)},
                   {"improved: lambda, dist-2", 0.15, weight_of("wu", sub_target_distance_critic)}});
  const local_planner::PaperLimits limits = limits_of("wu");
  append_settings(
      rows, "WU 1",
      {{"maximum line velocity, m/s", 1, limits.max_speed_mps},
       {"minimum line velocity, m/s", 0, std::nullopt},
       {"maximum angular velocity, rad/s", 0.35, limits.max_turn_radps},
       {"minimum angular velocity, rad/s", -0.35, -limits.max_turn_radps},
       {"maximum linear acceleration, m/s2", 0.2, limits.max_acceleration_mps2},
       {"minimum linear acceleration, m/s2", 0, -limits.max_deceleration_mps2, "with 0 the forklift could never brake"},
       {"maximum angular acceleration, rad/s2", 0.9, limits.max_turn_acceleration_radps2},
       {"minimum angular acceleration, rad/s2", -0.9, -limits.max_turn_acceleration_radps2},
       {"prediction time T, s", 3, limits.horizon_s},
       {"interval time dt, s", 0.1, local_planner::find_variant("wu")->printed.interval_s, "of the drive as printed"}});
}

void append_figures(std::vector<PublishedRow>& rows) {
  append(rows, PlanTable{"WU figure 8",
                         "",
                         "wu",
                         {{"turns", PlanFigure::kTurns}},
                         {{"traditional A*", "traditional", {8}}, {"improved A*", "wu", {3}}}});
  append_claim(rows, "WU figure 8", "turning times reduced", "62.5 %", ClaimedDirection::kMore,
               PlanEvidence{"wu", "wu", "traditional", PlanFigure::kTurns, true});
  append_claim(rows, "WU figure 8", "smaller turning angle", "smaller", ClaimedDirection::kLess,
               PlanEvidence{"wu", "wu", "traditional", PlanFigure::kTurned});
  const auto drive = [&](const char* table, const char* row, const char* published, ClaimedDirection claim,
                         DriveFigure figure, const char* note = "") {
    append_claim(rows, table, row, published, claim, DriveEvidence{kScene, "improved", "improved-traditional", figure},
                 note);
  };
  drive("WU figure 9", "the local path is closer to the global path", "closer", ClaimedDirection::kLess,
        DriveFigure::kDistanceToPath);
  drive("WU figure 9", "the actual moving distance is significantly reduced", "shorter", ClaimedDirection::kLess,
        DriveFigure::kLength);
  drive("WU figure 9", "the overall path smoothness is better", "smoother", ClaimedDirection::kLess,
        DriveFigure::kChangesOfW);
  drive("WU figures 10 and 11", "line speed near the obstacle, m/s, original -> improved",
        "0.6-0.7 -> 0.3-0.4, 0.5-0.6", ClaimedDirection::kLess, DriveFigure::kSpeedNear,
        "where a wall or the box is within 0.6 m");
  drive("WU figures 10 and 11", "angular velocity, rad/s, original -> improved", "[-0.4, 0.4] -> [-0.3, 0.4]",
        ClaimedDirection::kLess, DriveFigure::kRangeOfW);
  drive("WU figures 10 and 11", "angle adjustment is stable when approaching obstacles, jitter is small", "less jitter",
        ClaimedDirection::kLess, DriveFigure::kChangesOfW);
  using Property = WindowEvidence::Property;
  append_claim(rows, "WU figure 12", "a fast mover that will not collide: drives on along the path", "no detour",
               ClaimedDirection::kHolds, WindowEvidence{"window-ahead", Property::kNoDetour});
  append_claim(rows, "WU figure 13", "a slow mover that will not collide: drives on along the path", "no detour",
               ClaimedDirection::kHolds, WindowEvidence{"window-behind", Property::kNoDetour});
  append_claim(rows, "WU figure 14", "a mover on collision course: avoids it by a local path, returns to the path",
               "detour and return", ClaimedDirection::kHolds,
               WindowEvidence{"window-collision", Property::kDetoursAndReturns});
  append_claim(rows, "WU figure 15", "an unknown static obstacle: avoids it by a local path, returns to the path",
               "detour and return", ClaimedDirection::kHolds,
               WindowEvidence{"window-box", Property::kDetoursAndReturns},
               "our own drive searches its detour on a lattice; as printed the local sub-target leads around");
}

/// A cell of table 2. `evidence` measures the property, a share of maps or drives; the paper's tick is `has`.
void append_property(std::vector<PublishedRow>& rows, const char* algorithm, const char* property, bool has,
                     Evidence evidence, const char* note = "") {
  append_claim(rows, "WU 2", (std::string(algorithm) + ": " + property).c_str(), has ? "yes" : "no",
               has ? ClaimedDirection::kHolds : ClaimedDirection::kHoldsNot, std::move(evidence), note);
}

void append_comparison(std::vector<PublishedRow>& rows) {
  const auto optimal = [](const char* planner) { return PlanEvidence{"wu", planner, nullptr, PlanFigure::kIsOptimal}; };
  const auto fewer_turns = [](const char* planner) {
    return PlanEvidence{"wu", planner, "traditional", PlanFigure::kTurns};
  };
  const auto drives = [](const char* contestant, DriveFigure figure) {
    return DriveEvidence{kScene, contestant, nullptr, figure};
  };
  const auto passes_movers = [](const char* contestant) {
    return DriveEvidence{"wu-mover", contestant, nullptr, DriveFigure::kArrivesUntouched};
  };
  const NoEvidence path{"a path alone neither slows nor avoids what comes later"};
  const NoEvidence words{"the paper does not say by which figure an algorithm is locally optimal"};
  const NoEvidence compared_with{"it is what the others are compared with"};
  constexpr const char* kTurns = "by turning points against the traditional A*";
  constexpr const char* kArrives = "the share of drives that arrive at all";
  constexpr const char* kMover = "the share of drives past a mover that arrive and touch nothing";
  append_property(rows, "Tradition A*", "Global Optimality", true, optimal("astar"));
  append_property(rows, "Tradition A*", "Smooth Path", false, compared_with);
  append_property(rows, "Tradition A*", "Local Optimality", false, words);
  append_property(rows, "Tradition A*", "Deceleration Obstacle Avoidance", false, path);
  append_property(rows, "Tradition A*", "Dynamic Obstacle Avoidance", false, path);
  append_property(rows, "Improved A*", "Global Optimality", true, optimal("wu"));
  append_property(rows, "Improved A*", "Smooth Path", true, fewer_turns("wu"), kTurns);
  append_property(rows, "Improved A*", "Local Optimality", false, words);
  append_property(rows, "Improved A*", "Deceleration Obstacle Avoidance", false, path);
  append_property(rows, "Improved A*", "Dynamic Obstacle Avoidance", false, path);
  append_property(rows, "Tradition DWA", "Global Optimality", false, drives("dwa", DriveFigure::kArrives), kArrives);
  append_property(rows, "Tradition DWA", "Smooth Path", false,
                  DriveEvidence{kScene, "improved-traditional", "improved", DriveFigure::kChangesOfW},
                  "by changes of w against the improved DWA on the same path");
  rows.back().is_reference = true;
  append_property(rows, "Tradition DWA", "Local Optimality", true, words);
  append_property(rows, "Tradition DWA", "Deceleration Obstacle Avoidance", false,
                  DriveEvidence{kScene, "improved-traditional", "improved", DriveFigure::kSpeedNear},
                  "by the speed near obstacles against the improved DWA on the same path");
  rows.back().is_reference = true;
  append_property(rows, "Tradition DWA", "Dynamic Obstacle Avoidance", false, passes_movers("dwa"), kMover);
  append_property(rows, "Improved DWA", "Global Optimality", true, drives("improved", DriveFigure::kArrives), kArrives);
  append_property(rows, "Improved DWA", "Smooth Path", true,
                  DriveEvidence{kScene, "improved", "improved-traditional", DriveFigure::kChangesOfW},
                  "by changes of w against the traditional DWA on the same path");
  append_property(rows, "Improved DWA", "Local Optimality", true, words);
  append_property(rows, "Improved DWA", "Deceleration Obstacle Avoidance", true,
                  DriveEvidence{kScene, "improved", "improved-traditional", DriveFigure::kSpeedNear},
                  "by the speed near obstacles against the traditional DWA on the same path");
  append_property(rows, "Improved DWA", "Dynamic Obstacle Avoidance", false,
                  NoEvidence{"here the improved DWA always has its rolling window, which the paper counts as hybrid"});
  append_property(rows, "Hybrid Algorithm", "Global Optimality", true, drives("improved", DriveFigure::kArrives),
                  kArrives);
  append_property(rows, "Hybrid Algorithm", "Smooth Path", true,
                  DriveEvidence{kScene, "improved", "astar", DriveFigure::kChangesOfW},
                  "by changes of w against A* with the traditional DWA");
  append_property(rows, "Hybrid Algorithm", "Local Optimality", true, words);
  append_property(rows, "Hybrid Algorithm", "Deceleration Obstacle Avoidance", true,
                  DriveEvidence{kScene, "improved", "astar", DriveFigure::kSpeedNear},
                  "by the speed near obstacles against A* with the traditional DWA");
  append_property(rows, "Hybrid Algorithm", "Dynamic Obstacle Avoidance", true, passes_movers("improved"), kMover);
}

}  // namespace

void append_wu(std::vector<PublishedRow>& rows) {
  append_settings_of_wu(rows);
  append_figures(rows);
  append_comparison(rows);
}

}  // namespace aisle::lab
