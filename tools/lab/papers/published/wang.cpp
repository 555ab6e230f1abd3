// WANG: "Global Dynamic Path Planning of AGV Based on Fusion of Improved A* Algorithm and Dynamic Window Method".
#include "tools/lab/papers/published_table.hpp"
#include "tools/lab/planning/paper_maps.hpp"

namespace aisle::lab {
namespace {

using local_planner::clearance_critic;
using local_planner::heading_critic;
using local_planner::velocity_critic;

constexpr double kDegrees = 180.0 / geometry::kPi;
constexpr const char* kPathOnly = "the fusions differ in the path alone: WANG's critics and weights on both";

void append_settings_of_wang(std::vector<PublishedRow>& rows) {
  const local_planner::PaperLimits limits = limits_of("wang");
  append_settings(
      rows, "WANG section 5",
      {{"maximum linear velocity, m/s", 1.5, limits.max_speed_mps},
       {"maximum linear acceleration, m/s2", 1, limits.max_acceleration_mps2},
       {"maximum angular velocity, rad/s", 40, limits.max_turn_radps * kDegrees, "degrees, printed as radians"},
       {"maximum angular acceleration, rad/s2", 50, limits.max_turn_acceleration_radps2 * kDegrees,
        "degrees, printed as radians"},
       {"sigma", 1, std::nullopt},
       {"alpha, head", 0.05, weight_of("wang", heading_critic)},
       {"beta, dist", 0.2, weight_of("wang", clearance_critic)},
       {"gamma, velocity", 0.3, weight_of("wang", velocity_critic)},
       {"prediction time, s", 2, limits.horizon_s}});
  const local_planner::AsPrinted& printed = local_planner::find_variant("wang")->printed;
  append_settings(rows, "WANG section 5",
                  {{"linear velocity resolution, m/s", 0.05, printed.linear_step_mps,
                    "of the drive as printed; our own has 7 speeds in its window"},
                   {"angular velocity resolution, rad/s", 1, printed.angular_step_radps * kDegrees,
                    "degrees, printed as radians; of the drive as printed, our own has 17 turn rates in its window"}});
}

void append_paths(std::vector<PublishedRow>& rows) {
  append(rows, PlanTable{"WANG 1",
                         "",
                         "wang-1",
                         {{"path length, m", PlanFigure::kLength},
                          {"planning time", PlanFigure::kTime},
                          {"search scope, m2", PlanFigure::kExpanded}},
                         {{"Traditional A* Algorithm", "traditional-chebyshev", {30.73, 0.076, 228}},
                          {"Modified A* Algorithm", "modified-astar", {30.73, 0.061, 100}},
                          {"Improved A* Algorithm", "wang-without-passes", {30.73, 0.057, 96}}},
                         {"before the passes", "the text gives 0.076 s to the modified A*",
                          "the text gives 228 to the modified A*; its formula is not printed: our reading"}});
  append(rows, PlanTable{"WANG 2",
                         "",
                         "wang-1",
                         {{"planning time", PlanFigure::kTime},
                          {"number of path nodes", PlanFigure::kNodes},
                          {"number of turning points", PlanFigure::kTurns},
                          {"path length, m", PlanFigure::kLength}},
                         {{"Traditional A* algorithm", "traditional-chebyshev", {0.076, 28, 7, 30.73}},
                          {"Improved A* algorithm", "wang", {0.057, 4, 2, 28.53}}}});
  append(rows,
         DriveTable{"WANG 2",
                    "wang-2",
                    {{"planning time, s", DriveFigure::kTime}, {"path length, m", DriveFigure::kLength}},
                    {{"Fusion of traditional A* algorithm and dynamic window method", "astar-own", {70.56, 30.15}},
                     {"Fusion of Improved A* algorithm and dynamic window method", "improved", {57.67, 28.57}}},
                    {std::string(kPathOnly) + "; the time that the drive takes", kPathOnly}});
}

void append_percents(std::vector<PublishedRow>& rows) {
  const auto percent = [&](const char* row, const char* published, const char* planner, const char* reference,
                           PlanFigure figure, const char* note = "") {
    append_claim(rows, "WANG sections 5.1 and 5.2", row, published, ClaimedDirection::kMore,
                 PlanEvidence{"wang-1", planner, reference, figure, true}, note);
  };
  percent("planning time less than the traditional A*'s", "26.3 %", "wang-without-passes", "traditional-chebyshev",
          PlanFigure::kTime, "25 % by the table");
  percent("planning time less than the modified A*'s", "4 %", "wang-without-passes", "modified-astar",
          PlanFigure::kTime, "table 1 gives 6.6 %: the two are swapped");
  percent("search scope less than the traditional A*'s", "57.9 %", "wang-without-passes", "traditional-chebyshev",
          PlanFigure::kExpanded);
  percent("search scope less than the modified A*'s", "6.6 %", "wang-without-passes", "modified-astar",
          PlanFigure::kExpanded, "table 1 gives 4 %: the two are swapped");
  percent("path shorter", "7.2 %", "wang", "traditional-chebyshev", PlanFigure::kLength);
  percent("fewer path nodes", "85.7 %", "wang", "traditional-chebyshev", PlanFigure::kNodes);
  percent("fewer turning points", "71.4 %", "wang", "traditional-chebyshev", PlanFigure::kTurns);
  const auto fused = [&](const char* row, const char* published, DriveFigure figure) {
    append_claim(rows, "WANG sections 5.1 and 5.2", row, published, ClaimedDirection::kMore,
                 DriveEvidence{"wang-2", "improved", "astar-own", figure, true}, kPathOnly);
  };
  fused("fusion: less time", "18.3 %", DriveFigure::kTime);
  fused("fusion: shorter", "5.2 %", DriveFigure::kLength);
}

void append_maps(std::vector<PublishedRow>& rows) {
  for (const auto& [name, row] : {std::pair{"wang-map-1", "Map 1"}, {"wang-map-2", "Map 2"}, {"wang-map-3", "Map 3"}}) {
    const PaperMapKind& kind = *find_paper_map_kind(name);
    const bool is_large = std::string(name) == "wang-map-3";
    const std::string prefix = row;
    const double published_edge = is_large ? 40 : 20;
    const double published_blocks = is_large ? 74 : std::string(name) == "wang-map-1" ? 5 : 19;
    append_settings(
        rows, "WANG 3",
        {{(prefix + ": size, m").c_str(), published_edge, static_cast<double>(kind.edge)},
         {(prefix + ": start, x and y, m").c_str(), 1.5, kind.start.x + 0.5},
         {(prefix + ": target, x and y, m").c_str(), is_large ? 39.5 : 19.5, kind.goal.x + 0.5},
         {(prefix + ": known obstacles").c_str(), published_blocks, static_cast<double>(kind.most_blocks)}});
  }
}

void append_dynamic(std::vector<PublishedRow>& rows) {
  const auto drive = [&](const char* scene, const char* row, const char* length, const char* time) {
    const std::string prefix = row;
    append_claim(rows, "WANG section 5.3",
                 (prefix + ": avoids the mover and the unknown obstacle, reaches the target").c_str(), "yes",
                 ClaimedDirection::kHolds, DriveEvidence{scene, "improved", nullptr, DriveFigure::kArrivesUntouched},
                 "the share of drives that arrive and touch nothing");
    append_claim(rows, "WANG section 5.3", (prefix + ": path length, m").c_str(), length, ClaimedDirection::kMore,
                 DriveEvidence{scene, "improved", "improved-plan", DriveFigure::kLength},
                 "5.2: slightly longer than the global path; published without its plan");
    append_claim(rows, "WANG section 5.3", (prefix + ": path-planning time, s").c_str(), time, ClaimedDirection::kLess,
                 DriveEvidence{scene, "improved", "astar-own", DriveFigure::kTime},
                 "published without a reference: against the path of A* with the same critics; the time that the drive "
                 "takes");
  };
  drive("wang-map-1", "Map 1", "29.30", "58.76");
  drive("wang-map-2", "Map 2", "28.46", "59.20");
  drive("wang-map-3", "Map 3", "57.14", "260.82");
}

}  // namespace

void append_wang(std::vector<PublishedRow>& rows) {
  append_settings_of_wang(rows);
  append_paths(rows);
  append_percents(rows);
  append_claim(rows, "WANG figure 6", "linear velocity changes less", "less", ClaimedDirection::kLess,
               DriveEvidence{"wang-2", "improved", "astar-own", DriveFigure::kChangesOfV}, kPathOnly);
  append_claim(rows, "WANG figure 7", "angular velocity changes less", "less", ClaimedDirection::kLess,
               DriveEvidence{"wang-2", "improved", "astar-own", DriveFigure::kChangesOfW}, kPathOnly);
  append_claim(rows, "WANG figure 5", "the driven way is slightly longer than the globally optimal path", "longer",
               ClaimedDirection::kMore, DriveEvidence{"wang-2", "improved", "improved-plan", DriveFigure::kLength});
  append_maps(rows);
  append_dynamic(rows);
}

}  // namespace aisle::lab
