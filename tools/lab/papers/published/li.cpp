// LI: "Towards Path Planning Algorithm Combining with A-Star Algorithm and Dynamic Window Approach Algorithm".
#include "services/global-planner/core/neighbours.hpp"
#include "tools/lab/papers/published_table.hpp"

namespace aisle::lab {
namespace {

using local_planner::clearance_critic;
using local_planner::heading_critic;
using local_planner::sub_target_heading_critic;
using local_planner::velocity_critic;

constexpr const char* kVertices =
    "LI's text calls them break points: its 44 % is the mean of 50 and 37.5 %, so turning points are compared";
constexpr const char* kFourMoves = "the baseline moves in four directions only: 18.00 and 38.00 m are such lengths";

/// How many of the eight neighbours LI counts as left when this one is an obstacle: the obstacle itself is counted.
double left_of_eight(unsigned blocked) {
  const unsigned mask = 0xFFU & ~(1U << blocked);
  double left = 1.0;
  for (unsigned steps = global_planner::kDrivableDiagonals[mask]; steps != 0; steps &= steps - 1) left += 1.0;
  return left;
}

void append_tables(std::vector<PublishedRow>& rows) {
  append_settings(rows, "LI I",
                  {{"obstacle at X (diagonal): remaining child nodes", 8, left_of_eight(4), "the obstacle is counted"},
                   {"obstacle at N (orthogonal): remaining child nodes", 6, left_of_eight(0), "the same"}});
  const std::vector<PlanColumn> columns{
      {"path length", PlanFigure::kLength}, {"vertices", PlanFigure::kTurns}, {"planning time", PlanFigure::kTime}};
  append(rows, PlanTable{"LI II",
                         "Simple environment",
                         "li-simple",
                         columns,
                         {{"Traditional A* algorithm", "traditional-four", {18.00, 10, 7.69}},
                          {"Improved A* algorithm", "li", {14.83, 5, 5.48}}},
                         {kFourMoves, kVertices}});
  append(rows, PlanTable{"LI II",
                         "Complex environment",
                         "li-complex",
                         columns,
                         {{"Traditional A* algorithm", "traditional-four", {38.00, 16, 22.89}},
                          {"Improved A* algorithm", "li", {29.85, 10, 11.03}}},
                         {kFourMoves, kVertices}});
  append_settings(rows, "LI III",
                  {{"Direction angle alpha", 0.05, weight_of("li", heading_critic)},
                   {"Static distance beta", 0.2, weight_of("li", clearance_critic)},
                   {"Dynamic Distance gamma", 0.3, weight_of("li", velocity_critic),
                    "eq. 10 has gamma before vel: read as the weight of the speed"},
                   {"Smoothing factor sigma", 1, std::nullopt},
                   {"Offset term eta", 0.1, weight_of("li", sub_target_heading_critic)}});
}

/// Section IV.C: eq. 10 is proposed so that the car "can slow down in advance"; no other means is printed.
void append_slowing(std::vector<PublishedRow>& rows) {
  const auto slower = [&](const char* row, DriveFigure figure, const char* note) {
    append_claim(rows, "LI section IV.C", row, "slower", ClaimedDirection::kLess,
                 DriveEvidence{"li-iv", "improved-by-critics", "improved-traditional-by-critics", figure}, note);
  };
  slower("the evaluation of eq. 10 slows the car down when it encounters obstacles", DriveFigure::kSpeedNear,
         "where a wall or box is within 0.6 m, against the traditional critics on the same path; our own slowing, "
         "which no paper has, is off in both");
  slower("the evaluation of eq. 10 slows the car down at turning points", DriveFigure::kSpeedNearTurn,
         "within 1 m of a node where the path turns by more than 20 degrees; else the same");
}

void append_fused(std::vector<PublishedRow>& rows) {
  constexpr const char* kTimes = "the paper adds the whole simulated drive to the planning time";
  const DriveEvidence turns{"li-iv", "improved", "improved-plan", DriveFigure::kSharpTurns};
  const DriveEvidence length{"li-iv", "improved", "improved-plan", DriveFigure::kLength};
  const auto as_reference = [](DriveEvidence of) {
    std::swap(of.contestant, of.reference);
    return of;
  };
  const auto reference = [&](const char* row, const char* published, ClaimedDirection claim, const DriveEvidence& of) {
    append_claim(rows, "LI IV", row, published, claim, as_reference(of));
    rows.back().is_reference = true;
  };
  reference("Global planning path: number of inflection points", "1", ClaimedDirection::kMore, turns);
  reference("Global planning path: path length", "29.85", ClaimedDirection::kLess, length);
  append_claim(rows, "LI IV", "Global planning path: planning time", "11.28", ClaimedDirection::kHolds,
               NoEvidence{kTimes});
  append_claim(rows, "LI IV", "Final path: number of inflection points", "0", ClaimedDirection::kLess, turns,
               "sharp turns of the driven way");
  append_claim(rows, "LI IV", "Final path: path length", "38.6", ClaimedDirection::kMore, length);
  append_claim(rows, "LI IV", "Final path: planning time", "60.5", ClaimedDirection::kHolds, NoEvidence{kTimes});
}

}  // namespace

void append_li(std::vector<PublishedRow>& rows) {
  append_tables(rows);
  append_claim(rows, "LI section V.A", "fewer break points, both environments", "44 %", ClaimedDirection::kMore,
               PlanEvidence{"li-simple,li-complex", "li", "traditional-four", PlanFigure::kTurns, true},
               "table II gives 50 and 37.5 %");
  append_claim(rows, "LI section V.A", "shorter path, both environments", "17.18 %", ClaimedDirection::kMore,
               PlanEvidence{"li-simple,li-complex", "li", "traditional-four", PlanFigure::kLength, true},
               "does not follow from table II, which gives 17.61 and 21.45 %");
  append_claim(rows, "LI section V.A", "less planning time, both environments", "14.68 %", ClaimedDirection::kMore,
               PlanEvidence{"li-simple,li-complex", "li", "traditional-four", PlanFigure::kTime, true},
               "does not follow from table II, which gives 28.74 and 51.81 %");
  append_slowing(rows);
  append_claim(rows, "LI figures 11 and 12", "facing a dynamic obstacle, the car slows down", "slower",
               ClaimedDirection::kLess, DriveEvidence{"li-iv", "improved", nullptr, DriveFigure::kSpeedNearMover});
  append_claim(rows, "LI figures 12 and 13", "facing a dynamic obstacle, it changes its angular velocity and attitude",
               "turns more", ClaimedDirection::kMore,
               DriveEvidence{"li-iv", "improved", nullptr, DriveFigure::kTurnNearMover});
  append_fused(rows);
  append(rows, PlanTable{"LI V",
                         "",
                         "li-complex",
                         {{"path length", PlanFigure::kLength},
                          {"vertices", PlanFigure::kTurns},
                          {"planning time", PlanFigure::kTime}},
                         {{"Improved A* algorithm", "li", {29.85, 10, 11.03}},
                          {"Ant Colony Algorithm", "ant-colony", {32.04, 9, 12.08}}},
                         {"", kVertices}});
  append_claim(rows, "LI figure 14", "the ants' path passes obliquely through the vertices of obstacles", "yes",
               ClaimedDirection::kHolds, NoEvidence{"our ants cut no corner, as no vehicle may"});
}

}  // namespace aisle::lab
