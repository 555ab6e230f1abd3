#include "bench/queries/rows.hpp"

#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

namespace aisle::bench {
namespace {

using Figure = std::function<double(const Row&)>;

/// Each once, in the order of their first row.
std::vector<std::string> names(const std::vector<Row>& rows, std::string Row::*field) {
  std::vector<std::string> found;
  for (const Row& row : rows) {
    if (std::find(found.begin(), found.end(), row.*field) == found.end()) found.push_back(row.*field);
  }

  return found;
}

bool is_near(const std::string& map) { return map.find("(near)") != std::string::npos; }

/// Mean over the rounds; nothing when it did not answer everything there.
std::optional<double> over_rounds(const std::vector<Row>& rows, const std::string& map, const std::string& planner,
                                  const Figure& figure) {
  double sum = 0.0;
  int count = 0;

  for (const Row& row : rows) {
    if (row.map != map || row.planner != planner) continue;
    if (!row.is_whole()) return {};
    sum += figure(row);
    ++count;
  }

  return count == 0 ? std::nullopt : std::optional<double>(sum / count);
}

double mean_us(const Row& row) { return row.mean_us; }
double ns_an_expansion(const Row& row) { return 1e3 * row.mean_us / std::max(1.0, row.expanded_mean); }

/// Geometric mean over the maps of one planner's figure over another's; nothing when one of them misses a map.
std::optional<double> ratio(const std::vector<Row>& rows, const std::string& ours, const std::string& theirs,
                            const Figure& figure) {
  double logs = 0.0;
  int count = 0;

  for (const std::string& map : names(rows, &Row::map)) {
    if (is_near(map)) continue;

    const auto a = over_rounds(rows, map, ours, figure);
    const auto b = over_rounds(rows, map, theirs, figure);
    if (!a || !b) return {};

    logs += std::log(*a / *b);
    ++count;
  }

  return count == 0 ? std::nullopt : std::optional<double>(std::exp(logs / count));
}

/// One line, left out when the figure is not known.
void goal(std::ostream& out, const std::string& what, std::optional<double> figure, double limit,
          const char* note = "") {
  if (!figure) return;
  fmt::print(out, "  {:<78}{:>9.3f}  <= {:<7.3f}{}{}\n", what, *figure, limit, *figure <= limit ? "met" : "MISSED",
             note);
}

}  // namespace

void write_csv(std::ostream& out, const std::vector<std::string>& about, const std::vector<Row>& rows) {
  for (const std::string& line : about) fmt::print(out, "# {}\n", line);

  fmt::print(out,
             "map,planner,round,queries,asked,solved,undrivable,mean_us,p50_us,p99_us,expanded_mean,length_ratio_mean,"
             "length_ratio_max,bytes_a_cell\n");

  for (const Row& r : rows) {
    fmt::print(out, "{},{},{},{},{},{},{},{:.3f},{:.3f},{:.3f},{:.1f},{:.6f},{:.6f},{:.2f}\n", r.map, r.planner,
               r.round, r.queries, r.asked, r.solved, r.undrivable, r.mean_us, r.p50_us, r.p99_us, r.expanded_mean,
               r.length_ratio_mean, r.length_ratio_max, r.bytes_a_cell);
  }
}

void print_table(std::ostream& out, const std::vector<Row>& rows) {
  for (const std::string& map : names(rows, &Row::map)) {
    const auto base = over_rounds(rows, map, "textbook", mean_us);
    fmt::print(out, "\n{}\n  {:<18}{:>12}{:>12}{:>12}{:>10}{:>10}{:>9}{:>11}\n", map, "planner", "mean us", "p99 us",
               "expanded", "ns/exp.", "length", "solved", "x textbook");

    // The round in the middle, by the time that this planner took.
    for (const std::string& planner : names(rows, &Row::planner)) {
      std::vector<Row> of_it;
      for (const Row& row : rows) {
        if (row.map == map && row.planner == planner) of_it.push_back(row);
      }

      if (of_it.empty()) continue;

      std::sort(of_it.begin(), of_it.end(), [](const Row& a, const Row& b) { return a.mean_us < b.mean_us; });

      const Row& r = of_it[of_it.size() / 2];
      fmt::print(out, "  {:<18}{:>12.1f}{:>12.1f}{:>12.0f}{:>10.1f}{:>10.4f}{:>9}{:>11.3f}{}{}\n", planner, r.mean_us,
                 r.p99_us, r.expanded_mean, ns_an_expansion(r), r.length_ratio_mean,
                 fmt::format("{}/{}", r.solved, r.asked), base ? r.mean_us / *base : 0.0,
                 r.asked < r.queries ? "  (took too long for all)" : "",
                 r.undrivable > 0 ? fmt::format("  {} UNDRIVABLE", r.undrivable) : "");
    }
  }
}

/// A goal whose figures are missing is left out.
void print_goals(std::ostream& out, const std::vector<Row>& rows, const std::vector<Bound>& ros_maps) {
  fmt::print(out, "\ngoals: geometric means over the maps, means over the rounds of one run\n");
  goal(out, "exact A* to Boost.Graph A*, time", ratio(rows, "astar", "boost", mean_us), 0.25);
  goal(out, "exact A* to the textbook A*, ns an expansion", ratio(rows, "astar", "textbook", ns_an_expansion), 0.30);
  goal(out, "jump points to our exact A*, time", ratio(rows, "jps", "astar", mean_us), 0.25);

  const auto removal = ratio(rows, "astar+removal", "astar", mean_us);
  goal(out, "node removal over the search it follows, added share of its time",
       removal ? std::optional<double>(*removal - 1.0) : removal, 0.20);

  std::size_t undrivable = 0;
  double bytes = 0.0;

  for (const Row& row : rows) {
    undrivable += row.undrivable;

    if (is_near(row.map) && row.round == 1 && (row.planner == "astar" || row.planner == "jps")) {
      bytes = std::max(bytes, row.bytes_a_cell);
      const auto p50_us = over_rounds(rows, row.map, row.planner, [](const Row& r) { return r.p50_us; });
      goal(out, "query of 3 cells on the largest map, " + row.planner + ", us (median of the queries)", p50_us, 5.0);
    }
  }

  if (bytes > 0.0) goal(out, "memory of a query on the largest map, bytes a cell, astar and jps", bytes, 16.0);
  goal(out, "answers of ours that the path checker refuses, all variants", static_cast<double>(undrivable), 0.0);

  // Planners whose paths are shorter than the grid's optimum.
  for (const std::string& planner : names(rows, &Row::planner)) {
    const auto length = [&](const std::string& map) {
      return over_rounds(rows, map, planner, [](const Row& r) { return r.length_ratio_mean; });
    };

    double longest = 0.0;
    for (const std::string& map : names(rows, &Row::map))
      longest = std::max(longest, is_near(map) ? 0.0 : length(map).value_or(9.0));

    const auto time = ratio(rows, planner, "textbook", mean_us);
    if (time && longest < 0.999)
      goal(out, planner + ": improved variant to the textbook A*, time; longest map " + fmt::format("{:.4f}", longest),
           time, 0.15);

    for (const Bound& bound : ros_maps) {
      const auto of_map = length(bound.map);
      if (of_map && *of_map < 0.999)
        goal(out, planner + ": length to the any-angle bound on " + bound.map, *of_map / bound.any_angle, 1.010);
    }
  }
}

}  // namespace aisle::bench
