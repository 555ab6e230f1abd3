// QU: "Robot Path Planning Research Incorporating Improved A* Algorithm and DWA Algorithm".
#include "tools/lab/papers/published_table.hpp"

namespace aisle::lab {
namespace {

using local_planner::dynamic_clearance_critic;
using local_planner::heading_critic;
using local_planner::static_clearance_critic;
using local_planner::velocity_critic;

constexpr double kDegrees = 180.0 / geometry::kPi;

void append_settings_of_qu(std::vector<PublishedRow>& rows) {
  append_settings(rows, "QU section 5.1",
                  {{"alpha, Head", 0.2, weight_of("qu", heading_critic)},
                   {"beta, DistS", 0.1, weight_of("qu", static_clearance_critic)},
                   {"gamma, Vel", 0.3, weight_of("qu", velocity_critic)},
                   {"eta, DistD", 0.4, weight_of("qu", dynamic_clearance_critic)}});
  const local_planner::PaperLimits limits = limits_of("qu");
  const local_planner::AsPrinted& printed = local_planner::find_variant("qu")->printed;
  const char* const sampled = "of the drive as printed; our own has 7 speeds and 17 turn rates in its window";
  append_settings(rows, "QU 1",
                  {{"Initial line speed, m/s", 0, std::nullopt},
                   {"Max. linear speed, m/s", 2, limits.max_speed_mps},
                   {"Max. linear acceleration, m/s2", 0.4, limits.max_acceleration_mps2}});
  append_settings(rows, "QU 1",
                  {{"Initial azimuth angle, pi rad", -0.5, printed.start_yaw_rad.value_or(0.0) / geometry::kPi,
                    "of the drive as printed; our own begins with a turn on the spot towards the path"},
                   {"Angular speed fractional variability, deg/s", 1, printed.angular_step_radps * kDegrees, sampled},
                   {"Initial angular velocity, deg/s", 0, std::nullopt, "printed twice"},
                   {"Max. angular velocity, deg/s", 40, limits.max_turn_radps * kDegrees},
                   {"Max. angular acceleration, deg/s2", 60, limits.max_turn_acceleration_radps2 * kDegrees}});
  append_settings(
      rows, "QU 1",
      {{"Linear speed resolution, m/s", 0.01, printed.linear_step_mps, sampled}, {"dt, s", 0.1, printed.interval_s}});
}

void append_paths(std::vector<PublishedRow>& rows, const char* scene, const char* map, double turns, double turns_to,
                  double length, double length_to, const char* fewer, const char* shorter, const char* slip) {
  append(rows, PlanTable{"QU 2",
                         scene,
                         map,
                         {{"turning points", PlanFigure::kTurns}, {"path length, m", PlanFigure::kLength}},
                         {{"Traditional A* algorithm", "traditional", {turns, length}},
                          {"Improving the A* algorithm", "qu", {turns_to, length_to}}}});
  const std::string row = std::string(scene) + ", Improving the A* algorithm: ";
  append_claim(rows, "QU 2", (row + "turning point optimization ratio").c_str(), fewer, ClaimedDirection::kMore,
               PlanEvidence{map, "qu", "traditional", PlanFigure::kTurns, true});
  append_claim(rows, "QU 2", (row + "path length optimization ratio").c_str(), shorter, ClaimedDirection::kMore,
               PlanEvidence{map, "qu", "traditional", PlanFigure::kLength, true}, slip);
}

void append_fused(std::vector<PublishedRow>& rows, const char* row, const char* scene, const char* length,
                  const char* ratio, const char* slip) {
  const auto named = [&](const char* column) { return std::string(row) + ": " + column; };
  append_claim(rows, "QU 3", named("path length, m").c_str(), length, ClaimedDirection::kLess,
               DriveEvidence{scene, "improved", "traditional-plan", DriveFigure::kLength},
               "against the path of the traditional A*");
  append_claim(rows, "QU 3", named("path length optimization ratio").c_str(), ratio, ClaimedDirection::kMore,
               DriveEvidence{scene, "improved", "traditional-plan", DriveFigure::kLength, true}, slip);
  append_claim(rows, "QU 3", named("avoid dynamic obstacles").c_str(), "Yes", ClaimedDirection::kHolds,
               DriveEvidence{scene, "improved", nullptr, DriveFigure::kArrivesUntouched},
               "the share of drives that met a mover, arrived and touched nothing");
}

void append_blind_drive(std::vector<PublishedRow>& rows, const char* row, const char* scene) {
  append_claim(
      rows, "QU figures 6 and 7", row, "collides", ClaimedDirection::kMore,
      DriveEvidence{scene, "improved-blind", "improved", DriveFigure::kTouches},
      "the share of drives that touch a mover, at two thirds of the top speed without looking, against that of "
      "the fused drive");
}

}  // namespace

void append_qu(std::vector<PublishedRow>& rows) {
  append_settings_of_qu(rows);
  append_paths(rows, "Map 1", "qu-simple", 8, 2, 24.4879, 21.0280, "75 %", "15.48 %", "its own lengths give 14.13 %");
  append_paths(rows, "Map 2", "qu-maze", 12, 5, 30.3848, 25.1659, "58.33 %", "17.18 %", "");
  append_claim(rows, "QU figure 5", "the path of the improved algorithm is safer, the other is closer to the obstacle",
               "safer", ClaimedDirection::kMore, PlanEvidence{"qu-simple", "qu", "traditional", PlanFigure::kClearance},
               "by the least clearance along the path");
  append_fused(rows, "Map 1, one mover", "qu-1-one", "21.0337", "15.46 %", "its own lengths give 14.11 %");
  append_fused(rows, "Map 1, two movers", "qu-1-two", "21.5279", "13.47 %", "its own lengths give 12.09 %");
  append_fused(rows, "Map 2, one mover", "qu-2-one", "26.1942", "13.79 %", "");
  append_fused(rows, "Map 2, two movers", "qu-2-two", "26.6783", "12.20 %", "");
  append_blind_drive(rows, "map 1: driving the path of the improved A* alone collides with the movers", "qu-1-two");
  append_blind_drive(rows, "map 2: driving the path of the improved A* alone collides with the movers", "qu-2-two");
  append_claim(rows, "QU figure 8", "linear velocity falls while two movers are avoided", "falls",
               ClaimedDirection::kLess, DriveEvidence{"qu-1-two", "improved", nullptr, DriveFigure::kSpeedNearMover});
  append_claim(rows, "QU figure 8", "angular velocity falls while two movers are avoided", "falls",
               ClaimedDirection::kLess, DriveEvidence{"qu-1-two", "improved", nullptr, DriveFigure::kTurnNearMover});
}

}  // namespace aisle::lab
