// aisle lab: the tables and figures of the five papers by name, and each of them made again.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/process/exit_code.hpp"
#include "common/process/signals.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/progress_line.hpp"
#include "tools/cli/text.hpp"
#include "tools/lab/papers/published.hpp"
#include "tools/lab/papers/reproduce.hpp"
#include "tools/lab/parameters/named_parameters.hpp"

namespace aisle::cli {
namespace {

int list(const Cli& cli) {
  std::map<std::string, int> rows;
  for (const lab::PublishedRow& row : lab::published_rows()) ++rows[row.table];
  std::vector<std::vector<std::string>> table{{"table", "rows"}};
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const std::string& name : lab::published_tables()) {
    table.push_back({name, std::to_string(rows[name])});
    json.push_back({{"table", name}, {"rows", rows[name]}});
  }
  std::printf("%s", cli.json ? (json.dump() + "\n").c_str() : text_of_table(table).c_str());
  return process::kDone;
}

std::string shown(const std::optional<double>& figure) { return figure ? lab::shown_figure(*figure) : "-"; }

/// The rows as a person reads them.
std::string text_of(const std::vector<lab::ReproducedRow>& rows) {
  std::vector<std::vector<std::string>> table{
      {"table", "row", "published", "ours", "its reference", "n", "verdict", "why"}};
  for (const lab::ReproducedRow& row : rows)
    table.push_back({row.of->table, row.of->row, row.of->published, shown(row.ours), shown(row.reference),
                     std::to_string(row.n), lab::name(row.verdict), row.why});
  const lab::VerdictCount counted = lab::count(rows);
  return "same direction " + std::to_string(counted.same_direction) + ", other direction " +
         std::to_string(counted.other_direction) + ", not comparable " + std::to_string(counted.not_comparable) +
         " (rows that others are compared with count once)\n\n" + text_of_table(table);
}

struct LabOrders {
  std::string name;
  int seed{1};
  int maps{200};
  int drives{30};
};

int reproduce(const Cli& cli, const LabOrders& orders) {
  process::end_on_signals();
  lab::Reproduction reproduction;
  reproduction.tables = lab::tables_named(orders.name);
  const auto seed = static_cast<unsigned>(orders.seed);
  reproduction.maps = {orders.maps, seed};
  reproduction.drives = {orders.drives, seed};
  ProgressLine progress;
  const std::vector<lab::ReproducedRow> rows =
      lab::reproduce(reproduction, [&](const std::string& what) { progress.tell(what); });
  progress.clear();
  std::printf("%s", cli.json ? (lab::json_of(rows, seed).dump() + "\n").c_str() : text_of(rows).c_str());
  return process::kDone;
}

/// Every parameter of one planner, or of all.
int list_parameters(const Cli& cli, const std::string& planner) {
  std::vector<std::vector<std::string>> table{{"parameter", "default", "unit", "range", "counts with", "meaning"}};
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const lab::NamedParameter& it : lab::parameters_of_planner(planner)) {
    const std::string condition = it.condition.empty() ? "-" : it.condition;
    table.push_back({it.full_name(), it.default_value, it.unit, it.range, condition, it.meaning});
    json.push_back({{"parameter", it.full_name()},
                    {"side", lab::name(it.side)},
                    {"planner", it.planner},
                    {"name", it.name},
                    {"default", it.default_value},
                    {"unit", it.unit},
                    {"range", it.range},
                    {"condition", it.condition},
                    {"meaning", it.meaning}});
  }
  std::printf("%s", cli.json ? (json.dump() + "\n").c_str() : text_of_table(table).c_str());
  return process::kDone;
}

}  // namespace

void add_lab_parameters(CLI::App& parent, Cli& cli) {
  auto planner = std::make_shared<std::string>();
  Verb(parent, cli, "parameters",
       "lists what --set and --parameters may set: name, default, unit, range; of one planner, or of all")
      .optional_argument("PLANNER", *planner, "e.g. wang; global-planner and local-planner: the services' settings")
      .runs([&cli, planner] { return list_parameters(cli, *planner); });
}

void add_lab_list(CLI::App& parent, Cli& cli) {
  Verb(parent, cli, "list", "names the papers' tables and figures that can be made again, with their rows")
      .runs([&cli] { return list(cli); });
}

void add_lab_reproduce(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<LabOrders>();
  Verb(parent, cli, "reproduce",
       "makes one table, one paper or all of them again: published beside ours, with a verdict a row")
      .argument("NAME", orders->name, "e.g. wang-2, wu-figure-8, qu, all; see aisle lab list")
      .option("--seed", orders->seed, 1, 1000000, "draws other maps")
      .option("--maps", orders->maps, 2, 100000, "of each kind, for paths")
      .option("--drives", orders->drives, 0, 10000, "of each scene")
      .runs([&cli, orders] { return reproduce(cli, *orders); });
}

}  // namespace aisle::cli
