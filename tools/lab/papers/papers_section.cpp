#include "tools/lab/papers/papers_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "common/process/output_file.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/lab/page/templates.hpp"
#include "tools/lab/papers/commit.hpp"
#include "tools/lab/papers/comparison.hpp"
#include "tools/lab/planning/paper_maps.hpp"
#include "tools/lab/planning/plan_svg.hpp"

namespace aisle::lab {
namespace {

constexpr unsigned kShownMaps = 5;

/// In a cell of a markdown table no star may begin emphasis.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '*' ? std::string("\\*") : std::string(1, c);
  return safe;
}

std::string or_dash(const std::optional<double>& figure) { return figure ? shown_figure(*figure) : "-"; }

std::string interval(const ReproducedRow& row) {
  if (!row.interval95) return "-";
  return shown_figure((*row.interval95)[0]) + " to " + shown_figure((*row.interval95)[1]);
}

/// Verdicts paper by paper, without reference rows.
std::string counts_table(const std::vector<ReproducedRow>& rows) {
  std::vector<std::vector<std::string>> table{{"paper", "rows", "same direction", "other direction", "not comparable"}};
  const auto add = [&](const std::string& paper) {
    std::vector<ReproducedRow> of_paper;
    for (const ReproducedRow& row : rows)
      if (paper == "all" || row.of->table.rfind(paper + " ", 0) == 0) of_paper.push_back(row);
    const VerdictCount counted = count(of_paper);
    table.push_back({paper, std::to_string(counted.all()), std::to_string(counted.same_direction),
                     std::to_string(counted.other_direction), std::to_string(counted.not_comparable)});
  };
  for (const char* paper : {"LI", "WU", "QU", "YU", "WANG", "all"}) add(paper);
  return markdown_table(table);
}

/// The planner of the paper that a kind of maps belongs to: "li" of "li-simple".
std::string paper_of(const PaperMapKind& kind) {
  const std::string name = kind.name;
  return name.substr(0, name.find('-'));
}

std::string picture(const PaperMapKind& kind, unsigned seed) {
  const DrawnMap map = paper_map(kind, seed);
  const grid::ClearanceField clearance(map.grid, 10.0);
  global_planner::Problem problem{clearance, map.start_in_map, map.goal_in_map};
  problem.safe_distance_m = kPapersSafeDistanceM;
  const auto path = [&](const std::string& planner) {
    return plan_contestant(planner)->plan(problem, nullptr).waypoints_in_map;
  };
  const std::string paper = paper_of(kind);
  const std::string baseline = paper == "li"     ? "traditional-four"
                               : paper == "wang" ? "traditional-chebyshev"
                                                 : "traditional";
  return plan_svg(map.grid, {{"traditional A*", path(baseline)}, {paper, path(paper)}});
}

std::string kinds_table() {
  std::vector<std::vector<std::string>> table{{"maps", "of", "rule"}};
  for (const PaperMapKind& kind : paper_map_kinds()) table.push_back({kind.name, kind.paper, rule_of(kind)});
  return markdown_table(table);
}

}  // namespace

std::string papers_rows_table(const std::vector<ReproducedRow>& rows) {
  std::vector<std::vector<std::string>> table{{"table", "row", "published", "ours", "its reference", "n",
                                               "95 % of the difference", "p", "effect", "verdict", "why"}};
  for (const ReproducedRow& row : rows)
    table.push_back({row.of->table, escaped(row.of->row), row.of->published, or_dash(row.ours), or_dash(row.reference),
                     row.n > 0 ? std::to_string(row.n) : "-", interval(row), or_dash(row.wilcoxon_p),
                     or_dash(row.effect), name(row.verdict), row.why.empty() ? "-" : escaped(row.why)});
  return markdown_table(table);
}

std::string papers_pictures(const std::filesystem::path& folder, const std::string& from_page) {
  std::string text;
  for (const PaperMapKind& kind : paper_map_kinds()) {
    std::string line;
    for (unsigned seed = 1; seed <= kShownMaps; ++seed) {
      const std::string file = fmt::format("map-{}-{}.svg", kind.name, seed);
      process::write_output_file(folder / file, picture(kind, seed));
      line += fmt::format("![{}, seed {}]({}/{}) ", kind.name, seed, from_page, file);
    }
    line.pop_back();
    text += line + "\n\n";
  }
  return text;
}

FilledPage papers_section(const PapersExperiment& orders, const Progress& progress) {
  Reproduction reproduction;
  const auto seed = static_cast<unsigned>(orders.seed);
  reproduction.maps = {orders.maps, seed};
  reproduction.drives = {orders.drives, seed};
  const std::vector<ReproducedRow> rows = reproduce(reproduction, progress);
  const VerdictCount counted = count(rows);

  Texts texts;
  texts["commit"] = source_commit();
  texts["seed"] = std::to_string(orders.seed);
  texts["maps"] = std::to_string(orders.maps);
  texts["drives"] = std::to_string(orders.drives);
  texts["timed_runs"] = std::to_string(kTimedRuns);
  texts["long_plan_ms"] = fmt::format("{:.0f}", 1e-3 * kLongPlanUs);
  texts["all"] = std::to_string(counted.all());
  texts["counts"] = counts_table(rows);
  texts["iterations"] = std::to_string(kSamplingIterations);
  texts["comparator_maps"] = std::to_string(std::min(orders.maps, kComparatorMaps));
  texts["comparators"] = comparators_table(reproduction.maps, progress);
  texts["same"] = std::to_string(counted.same_direction);
  texts["other"] = std::to_string(counted.other_direction);
  texts["none"] = std::to_string(counted.not_comparable);
  texts["rows"] = papers_rows_table(rows);
  texts["kinds"] = kinds_table();
  texts["pictures"] = papers_pictures(orders.pictures, orders.pictures_from_page);
  return fill(kPapersTemplate, texts);
}

}  // namespace aisle::lab
