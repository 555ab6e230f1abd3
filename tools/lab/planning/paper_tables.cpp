#include "tools/lab/planning/paper_tables.hpp"

#include <memory>
#include <vector>

#include "common/config/reader.hpp"
#include "common/process/output_file.hpp"
#include "services/global-planner/core/traditional_astar.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/lab/planning/drawn_map.hpp"
#include "tools/lab/planning/plan_svg.hpp"
#include "tools/lab/planning/tally.hpp"

namespace aisle::lab {
namespace {

using global_planner::Heuristic;
using global_planner::Moves;

enum class Figure { kLength, kNodes, kTurns, kExpanded };

/// One line of a paper's table: what it reports for traditional A* and for its own.
struct Published {
  Figure figure;
  double traditional, improved;
};

struct Case {
  const char* map;  // deploy/experiments/<map>.txt
  const char* title;
  const char* planner;  // the paper's
  Heuristic heuristic;  // of its baseline
  Moves moves;
  std::vector<Published> published;
};

using F = Figure;
const std::vector<Case> kCases{
    {"li-simple",
     "LI table II, 10x10 simple",
     "li",
     Heuristic::kEuclidean,
     Moves::kFour,
     {{F::kLength, 18.00, 14.83}, {F::kTurns, 10, 5}}},
    {"li-complex",
     "LI table II, 20x20 complex",
     "li",
     Heuristic::kEuclidean,
     Moves::kFour,
     {{F::kLength, 38.00, 29.85}, {F::kTurns, 16, 10}}},
    {"wu", "WU figure 8", "wu", Heuristic::kEuclidean, Moves::kEight, {{F::kTurns, 8, 3}}},
    {"qu-simple",
     "QU table 2, 21x21 simple",
     "qu",
     Heuristic::kEuclidean,
     Moves::kEight,
     {{F::kLength, 24.4879, 21.0280}, {F::kTurns, 8, 2}}},
    {"qu-maze",
     "QU table 2, 21x21 maze",
     "qu",
     Heuristic::kEuclidean,
     Moves::kEight,
     {{F::kLength, 30.3848, 25.1659}, {F::kTurns, 12, 5}}},
    {"yu-1",
     "YU table 2, 20x20 scene 1",
     "yu",
     Heuristic::kEuclidean,
     Moves::kEight,
     {{F::kLength, 27.0026, 24.8729}, {F::kTurns, 5, 4}, {F::kExpanded, 108, 88}}},
    {"yu-2",
     "YU table 3, 20x20 scene 2",
     "yu",
     Heuristic::kEuclidean,
     Moves::kEight,
     {{F::kLength, 23.3848, 24.3454}, {F::kTurns, 9, 2}, {F::kExpanded, 112, 92}}},
    {"yu-3",
     "YU table 4, 50x50",
     "yu",
     Heuristic::kEuclidean,
     Moves::kEight,
     {{F::kLength, 62.2548, 60.0237}, {F::kTurns, 13, 8}, {F::kExpanded, 820, 211}}},
    {"wang-1",
     "WANG tables 1 and 2, 20x20",
     "wang",
     Heuristic::kChebyshev,
     Moves::kEight,
     {{F::kLength, 30.73, 28.53}, {F::kNodes, 28, 4}, {F::kTurns, 7, 2}, {F::kExpanded, 228, 96}}},
    {"wang-map-1", "WANG table 3, map 1, 5 blocks", "wang", Heuristic::kChebyshev, Moves::kEight, {}},
    {"wang-map-2", "WANG table 3, map 2, 19 blocks", "wang", Heuristic::kChebyshev, Moves::kEight, {}},
    {"wang-map-3", "WANG table 3, map 3, 40x40, 74 blocks", "wang", Heuristic::kChebyshev, Moves::kEight, {}},
};

/// One planner on the map of a case.
struct Row {
  std::string name;
  Answer answer;
};

/// What an answer has in that line of the table.
double figure_of(const Answer& answer, Figure figure) {
  switch (figure) {
    case Figure::kLength:
      return answer.figures.length_m;
    case Figure::kNodes:
      return answer.figures.nodes;
    case Figure::kTurns:
      return answer.figures.turning_points;
    case Figure::kExpanded:
      break;
  }
  return static_cast<double>(answer.plan.expanded);
}

const char* name_of(Figure figure) {
  switch (figure) {
    case Figure::kLength:
      return "length m";
    case Figure::kNodes:
      return "nodes";
    case Figure::kTurns:
      return "turning points";
    case Figure::kExpanded:
      break;
  }
  return "expanded";
}

std::string pair(Figure figure, double from, double to) {
  const int after_point = figure == Figure::kLength ? 2 : 0;
  return digits(from, after_point) + " -> " + digits(to, after_point);
}

/// Does the figure change in the way that the paper reports?
std::string verdict(const Published& published, double ours_from, double ours_to) {
  const bool claims_less = published.improved < published.traditional;
  if (ours_to == ours_from) return "equal";
  return (ours_to < ours_from) == claims_less ? "same direction" : "**other direction**";
}

/// QU and YU ask for one and print none.
bool keeps_safe_distance(const Case& of) { return std::string(of.planner) == "qu" || std::string(of.planner) == "yu"; }

constexpr double kSafeDistanceM = 0.3;  // as in the service
constexpr double kSafeDistancesM[] = {0.0, kSafeDistanceM, 0.5};

/// A paper's map with every planner's answer.
class PaperCase {
 public:
  /// @param safe_distance_m of QU and YU, beside lines, from the middle of a cell of 1 m
  PaperCase(const Case& of, double safe_distance_m, const std::filesystem::path& maps)
      : case_(of), safe_distance_m_(safe_distance_m), map_(read_drawn_map(maps / (std::string(of.map) + ".txt"), 1.0)) {
    const grid::ClearanceField clearance(map_.grid, 10.0);
    global_planner::Problem problem{clearance, map_.start_in_map, map_.goal_in_map};
    problem.safe_distance_m = safe_distance_m;
    rows_.push_back(
        {"traditional A*, as drawn", ask(*global_planner::traditional_astar(of.heuristic, of.moves), problem)});
    for (const global_planner::Variant& variant : global_planner::all_variants())
      rows_.push_back({variant.name, ask(*variant.make(), problem)});
    for (const Row& row : rows_) {
      if (row.answer.plan.outcome != global_planner::Outcome::kFound)
        throw config::BadInput(std::string(of.map) + ".txt: " + row.name + " finds no path");
    }
  }

  const Answer& of(const std::string& name) const {
    for (const Row& row : rows_) {
      if (row.name == name) return row.answer;
    }
    return rows_.front().answer;
  }

  /// The case, with the safe distance where its planner keeps one.
  std::string title() const {
    return case_.title + (keeps_safe_distance(case_) ? ", safe distance " + digits(safe_distance_m_, 1) + " m" : "");
  }

  /// The paper's figures beside ours.
  std::vector<std::vector<std::string>> compared() const {
    std::vector<std::vector<std::string>> lines;
    for (const Published& published : case_.published) {
      const double drawn = figure_of(rows_.front().answer, published.figure);
      const double astar = figure_of(of("astar"), published.figure);
      const double ours = figure_of(of(case_.planner), published.figure);
      lines.push_back(
          {title(), name_of(published.figure), pair(published.figure, published.traditional, published.improved),
           pair(published.figure, drawn, ours), verdict(published, drawn, ours), pair(published.figure, astar, ours)});
    }
    return lines;
  }

  /// A row for each planner.
  std::string all_planners() const {
    std::vector<std::vector<std::string>> table{
        {"planner", "length m", "nodes", "turning points", "turned rad", "expanded", "least clearance m"}};
    for (const Row& row : rows_) {
      const auto& f = row.answer.figures;
      table.push_back({row.name, digits(f.length_m, 2), std::to_string(f.nodes), std::to_string(f.turning_points),
                       digits(f.turning_angle_rad, 2), std::to_string(row.answer.plan.expanded),
                       digits(f.least_clearance_m, 2)});
    }
    return markdown_table(table);
  }

  /// The map with the baseline's path, the paper's and the shortest.
  std::string picture() const {
    return plan_svg(map_.grid, {{"traditional A*", rows_.front().answer.plan.waypoints_in_map},
                                {case_.planner, of(case_.planner).plan.waypoints_in_map},
                                {"theta", of("theta").plan.waypoints_in_map}});
  }

 private:
  const Case& case_;
  double safe_distance_m_;
  DrawnMap map_;
  std::vector<Row> rows_;
};

}  // namespace

std::string paper_tables(const std::filesystem::path& maps, const std::filesystem::path& pictures,
                         const std::string& pictures_from_page, const Progress& progress) {
  std::vector<std::vector<std::string>> compared{
      {"table", "figure", "published", "ours, from A* as drawn", "direction", "ours, from an A* that cuts no corner"}};
  std::string details;
  for (const Case& of : kCases) {
    progress(std::string("papers: ") + of.title);
    const PaperCase paper_case(of, kSafeDistanceM, maps);
    for (const double safe_distance_m : kSafeDistancesM) {
      if (!keeps_safe_distance(of) && safe_distance_m != kSafeDistanceM) continue;
      for (auto& line : PaperCase(of, safe_distance_m, maps).compared()) compared.push_back(std::move(line));
    }
    process::write_output_file(pictures / (std::string(of.map) + ".svg"), paper_case.picture());
    details += std::string("#### ") + of.title + "\n\n![" + of.title + "](" + pictures_from_page + "/" + of.map +
               ".svg)\n\n" + paper_case.all_planners();
  }
  return markdown_table(compared) + details;
}

}  // namespace aisle::lab
