#include "tools/lab/papers/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <utility>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/lab/papers/commit.hpp"
#include "tools/lab/papers/reproduce.hpp"
#include "tools/lab/planning/ompl_planners.hpp"
#include "tools/lab/planning/paper_maps.hpp"

namespace aisle::lab {
namespace {

using Strings = std::vector<std::string>;
using Measured = std::map<std::string, PlanFigures>;

[[noreturn]] void refuse(const std::string& what, const std::string& name, const Strings& known) {
  const std::string nearest = config::nearest_name(name, known);
  std::string all;
  for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
  throw config::BadInput("there is no " + what + " '" + name + "'" +
                         (nearest.empty() ? "." : "; did you mean " + nearest + "?") + " There are " + all);
}

/// Of the maps where the planner found a path.
double mean_found(const std::vector<double>& figures) {
  double sum = 0.0, found = 0.0;
  for (const double figure : figures)
    if (!std::isnan(figure)) sum += figure, found += 1.0;
  return sum / found;
}

/// Lengths of both, map by map, where both found a path.
PairedComparison compared_lengths(const PlanFigures& first, const PlanFigures& planner) {
  const std::vector<double>& all_a = first.at(PlanFigure::kLength);
  const std::vector<double>& all_b = planner.at(PlanFigure::kLength);
  std::vector<double> a, b;
  for (std::size_t i = 0; i < all_a.size(); ++i)
    if (!std::isnan(all_a[i]) && !std::isnan(all_b[i])) a.push_back(all_a[i]), b.push_back(all_b[i]);
  return compare_pairs(a, b);
}

ComparedPlanner row_of(const std::string& map_kind, const std::string& planner, const std::string& first,
                       const Measured& measured) {
  const PlanFigures& figures = measured.at(planner);
  const std::vector<double>& lengths_m = figures.at(PlanFigure::kLength);

  ComparedPlanner row;
  row.map_kind = map_kind;
  row.planner = planner;
  row.maps = lengths_m.size();
  row.found = static_cast<std::size_t>(
      std::count_if(lengths_m.begin(), lengths_m.end(), [](double length_m) { return !std::isnan(length_m); }));
  row.length_m = mean_found(lengths_m);
  row.turning_points = mean_found(figures.at(PlanFigure::kTurns));
  row.turned_rad = mean_found(figures.at(PlanFigure::kTurned));
  row.clearance_m = mean_found(figures.at(PlanFigure::kClearance));
  row.expanded = mean_found(figures.at(PlanFigure::kExpanded));
  row.time_us = mean_found(figures.at(PlanFigure::kTime));
  row.lengths = compared_lengths(measured.at(first), figures);
  return row;
}

std::string shown(double figure) { return std::isnan(figure) ? "-" : shown_figure(figure); }

nlohmann::ordered_json or_null(double figure) {
  return std::isnan(figure) ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(figure);
}

/// The planner that the others are compared with has nothing to be compared with.
bool is_first(const ComparedPlanner& row, const std::vector<ComparedPlanner>& all) {
  for (const ComparedPlanner& other : all)
    if (other.map_kind == row.map_kind) return other.planner == row.planner;
  return false;
}

}  // namespace

Strings contestants_named(const Strings& typed) {
  const Strings known = plan_contestant_names();
  Strings names;
  for (const std::string& words : typed) {
    std::istringstream in(words);
    for (std::string name; std::getline(in, name, ',');) {
      if (name.empty()) continue;
      if (std::find(known.begin(), known.end(), name) == known.end()) refuse("planner", name, known);
      names.push_back(name);
    }
  }
  return names;
}

Strings map_kinds_named(const std::string& name) {
  Strings found, known{"all"};
  for (const PaperMapKind& kind : paper_map_kinds()) {
    const std::string of = kind.name;
    if (name == "all" || name == of || name == of.substr(0, of.find('-'))) found.push_back(of);
    known.push_back(of);
  }
  if (found.empty()) refuse("kind of maps", name, known);
  return found;
}

std::vector<ComparedPlanner> compare(const Comparison& orders, const Progress& progress) {
  std::vector<ComparedPlanner> rows;
  for (const std::string& kind : orders.map_kinds) {
    progress("planning on maps of " + kind);
    const Measured measured =
        measure_plans(kind, std::set<std::string>(orders.planners.begin(), orders.planners.end()), orders.maps);
    for (const std::string& planner : orders.planners)
      rows.push_back(row_of(kind, planner, orders.planners.front(), measured));
  }
  return rows;
}

std::vector<Strings> rows_of(const std::vector<ComparedPlanner>& compared) {
  std::vector<Strings> rows{{"maps", "planner", "paths found", "length m", "95 % of the difference", "effect",
                             "turning points", "turned rad", "least clearance m", "expanded", "time us"}};
  for (const ComparedPlanner& row : compared) {
    const bool has_difference = !is_first(row, compared) && row.lengths.n > 0;
    rows.push_back(
        {row.map_kind, row.planner, fmt::format("{} of {}", row.found, row.maps), shown(row.length_m),
         has_difference ? shown_figure(row.lengths.interval95[0]) + " to " + shown_figure(row.lengths.interval95[1])
                        : "-",
         has_difference ? shown_figure(row.lengths.effect) : "-", shown(row.turning_points), shown(row.turned_rad),
         shown(row.clearance_m), shown(row.expanded), std::isnan(row.time_us) ? "-" : digits(row.time_us, 0)});
  }
  return rows;
}

nlohmann::ordered_json json_of(const std::vector<ComparedPlanner>& compared, unsigned seed) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const ComparedPlanner& row : compared) {
    nlohmann::ordered_json object{{"map", row.map_kind},
                                  {"planner", row.planner},
                                  {"n", row.maps},
                                  {"found", row.found},
                                  {"length_m", or_null(row.length_m)},
                                  {"turning_points", or_null(row.turning_points)},
                                  {"turned_rad", or_null(row.turned_rad)},
                                  {"clearance_m", or_null(row.clearance_m)},
                                  {"expanded", or_null(row.expanded)},
                                  {"time_us", or_null(row.time_us)},
                                  {"interval95", nullptr},
                                  {"wilcoxon_p", nullptr},
                                  {"effect", nullptr},
                                  {"library", is_ompl_planner(row.planner) ? ompl_version() : "aisle"},
                                  {"commit", source_commit()},
                                  {"seed", seed}};
    if (!is_first(row, compared) && row.lengths.n > 0) {
      object["interval95"] = row.lengths.interval95;
      object["wilcoxon_p"] = row.lengths.wilcoxon_p;
      object["effect"] = row.lengths.effect;
    }
    all.push_back(std::move(object));
  }
  return all;
}

std::string comparators_table(MapDraw maps, const Progress& progress) {
  maps.maps = std::min(maps.maps, kComparatorMaps);
  if (ompl_version().empty()) return "Not built in: OMPL was not there when this program was built.\n\n";

  std::vector<ComparedPlanner> all;
  for (const auto& [paper, kind] : std::vector<std::pair<std::string, std::string>>{
           {"li", "li-complex"}, {"wu", "wu"}, {"qu", "qu-maze"}, {"yu", "yu-3"}, {"wang", "wang-1"}}) {
    Comparison orders{{kind}, {paper, "astar", "theta"}, maps};
    for (const char* name : {"rrtstar", "informed-rrtstar", "bitstar"}) orders.planners.emplace_back(name);
    const std::vector<ComparedPlanner> rows = compare(orders, progress);
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return markdown_table(rows_of(all));
}

}  // namespace aisle::lab
