#include "tools/lab/papers/published_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace aisle::lab {
namespace {

/// What the paper says of `figure` beside that of its reference.
ClaimedDirection claim_of(double figure, double reference) {
  if (figure == reference) return ClaimedDirection::kEqual;
  return figure < reference ? ClaimedDirection::kLess : ClaimedDirection::kMore;
}

std::string note_of(const std::vector<std::string>& notes, std::size_t column) {
  return column < notes.size() ? notes[column] : std::string();
}

/// The rows of a table of planners or drives, which differ in their evidence alone.
template <class Table, class Evidence_>
void append_table(std::vector<PublishedRow>& rows, const Table& table, const std::string& before,
                  const Evidence_& evidence_of) {
  const auto& first = table.lines.front();
  const auto& own = table.lines.back();
  for (const auto& line : table.lines) {
    const bool is_reference = &line == &first;
    const auto& against = is_reference ? own : first;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      PublishedRow row;
      row.table = table.name;
      row.row = before + line.name + ": " + table.columns[i].name;
      row.published = as_printed(line.published[i]);
      row.printed_ratio = line.published[i] / first.published[i];
      row.claim = claim_of(line.published[i], against.published[i]);
      row.evidence = evidence_of(line, against, table.columns[i].figure);
      row.note = note_of(table.notes, i);
      row.is_reference = is_reference;
      rows.push_back(std::move(row));
    }
  }
}

}  // namespace

std::string as_printed(double number) { return fmt::format("{}", number); }

void append(std::vector<PublishedRow>& rows, const PlanTable& table) {
  const std::string scene = table.scene;
  append_table(rows, table, scene.empty() ? "" : scene + ", ",
               [&](const PlanLine& line, const PlanLine& against, PlanFigure figure) -> Evidence {
                 if (line.planner == nullptr) return NoEvidence{line.why};
                 return PlanEvidence{table.map, line.planner, against.planner, figure};
               });
}

void append(std::vector<PublishedRow>& rows, const DriveTable& table) {
  append_table(rows, table, "", [&](const DriveLine& line, const DriveLine& against, DriveFigure figure) -> Evidence {
    if (line.contestant == nullptr) return NoEvidence{line.why};
    return DriveEvidence{table.scene, line.contestant, against.contestant, figure};
  });
}

void append_settings(std::vector<PublishedRow>& rows, const char* table, const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    Evidence evidence = NoEvidence{"no parameter of ours"};
    if (setting.ours) evidence = SettingEvidence{*setting.ours};
    append_claim(rows, table, setting.name, as_printed(setting.published).c_str(), ClaimedDirection::kEqual,
                 std::move(evidence), setting.note);
  }
}

double weight_of(const char* planner, const local_planner::Critic& critic) {
  for (const local_planner::WeightedCritic& weighted : local_planner::find_variant(planner)->critics)
    if (weighted.critic == critic) return weighted.weight;
  return 0.0;
}

local_planner::PaperLimits limits_of(const char* planner) { return local_planner::find_variant(planner)->paper; }

void append_claim(std::vector<PublishedRow>& rows, const char* table, const char* row, const char* published,
                  ClaimedDirection claim, Evidence evidence, const char* note) {
  rows.push_back({table, row, published, claim, std::move(evidence), note, false});
}

const std::vector<PublishedRow>& published_rows() {
  static const std::vector<PublishedRow> all = [] {
    std::vector<PublishedRow> rows;
    append_li(rows);
    append_wu(rows);
    append_qu(rows);
    append_yu(rows);
    append_wang(rows);
    return rows;
  }();
  return all;
}

std::vector<std::string> published_tables() {
  std::vector<std::string> names;
  for (const PublishedRow& row : published_rows())
    if (std::find(names.begin(), names.end(), row.table) == names.end()) names.push_back(row.table);
  return names;
}

}  // namespace aisle::lab
