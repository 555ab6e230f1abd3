#include "tools/lab/driving/printed_table.hpp"

#include <algorithm>

#include "tools/lab/driving/fused_drive.hpp"
#include "tools/lab/driving/printed_drive.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/sim/site.hpp"

namespace aisle::lab {
namespace {

std::string times(int count) { return count == 1 ? "once" : std::to_string(count) + " times"; }

/// "arrives", "never arrives", with what it touched while it moved.
std::string end_of(const sim::Result& result) {
  const bool arrives = result.goals_reached == result.goals_assigned;
  const int touched = result.contacts_moving_vehicle;
  return std::string(arrives ? "arrives" : "**never arrives**") +
         (touched > 0 ? ", **touches** " + times(touched) : std::string());
}

std::string figure(const sim::Result& result, double value, int decimals) {
  return result.goals_reached == result.goals_assigned ? digits(value, decimals) : "-";
}

std::string met(const DriveFigures& own) {
  const auto [movers, boxes] = std::pair(own.encounters.movers.size(), own.encounters.boxes.size());
  return std::to_string(movers) + " and " + std::to_string(boxes);
}

}  // namespace

const std::vector<PrintedCase>& printed_cases() {
  static const std::vector<PrintedCase> all{
      {"li", "li-complex", {0, 0}},   {"li", "li-complex", {1, 2}},   {"wu", "wu", {0, 0}},
      {"wu", "wu", {0, 1}},           {"wu", "wu", {1, 0}},           {"qu", "qu-simple", {0, 0}},
      {"qu", "qu-simple", {1, 0}},    {"qu", "qu-simple", {2, 0}},    {"qu", "qu-maze", {0, 0}},
      {"qu", "qu-maze", {1, 0}},      {"qu", "qu-maze", {2, 0}},      {"yu", "yu-1", {0, 0}},
      {"yu", "yu-1", {0, 1}},         {"yu", "yu-1", {1, 1}},         {"wang", "wang-1", {0, 0}},
      {"wang", "wang-map-1", {1, 1}}, {"wang", "wang-map-2", {1, 1}}, {"wang", "wang-map-3", {1, 2}}};
  return all;
}

sim::Result drive_as_printed(const PrintedCase& of, const std::filesystem::path& maps) {
  const DrawnMap map = read_drawn_map(maps / (std::string(of.map) + ".txt"), 1.0);
  const local_planner::Variant variant = paper_variant(of.paper);
  sim::Setup setup = printed_setup(map, variant, global_planner_of(variant));
  add(encounters_of_paper(of.map, map, of.surprises, variant.paper.max_speed_mps), setup.scenario);
  return sim::drive(setup).result;
}

std::string printed_table(const std::filesystem::path& maps, const Progress& progress) {
  std::vector<std::vector<std::string>> rows{
      {"planner", "map", "movers and boxes", "as printed", "m", "s", "our own drive", "m", "s"}};
  for (const PrintedCase& of : printed_cases()) {
    progress(std::string("as printed: ") + of.paper + " on " + of.map);
    const sim::Result printed = drive_as_printed(of, maps);
    const local_planner::Variant variant = paper_variant(of.paper);
    const DriveFigures own = drive_fused({of.map, of.paper, variant, variant.paper, of.surprises}, maps);
    rows.push_back({of.paper, of.map, met(own), end_of(printed), figure(printed, printed.distance_m, 2),
                    figure(printed, printed.driven_s, 1), end_of(own.result),
                    figure(own.result, own.result.distance_m, 2), figure(own.result, own.result.driven_s, 1)});
  }
  return markdown_table(rows);
}

}  // namespace aisle::lab
