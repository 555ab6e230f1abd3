#include "tools/lab/tracking/detour_table.hpp"

#include <cstdint>
#include <utility>
#include <vector>

#include "common/config/reader.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/suite.hpp"

namespace aisle::lab {
namespace {

using sim::Perception;

/// Several drives, and how far beyond their plans they went.
struct Drives {
  sim::Totals totals;
  double planned_m{0.0};

  void add(const sim::Result& result) {
    totals.add(result);
    planned_m += result.planned_m;
  }

  void add(const Drives& others) {
    totals.add(others.totals);
    planned_m += others.planned_m;
  }
};

/// All seeds of one family.
Drives drive(const std::string& family, Perception perception, int seeds) {
  Drives drives;
  for (int seed = 1; seed <= seeds; ++seed) {
    sim::Setup setup = sim::make_setup(family, static_cast<std::uint64_t>(seed));
    setup.perception = perception;
    const std::string local = setup.local;
    drives.add(sim::run_in_time(std::move(setup), local));
  }

  return drives;
}

/// Means a run; goals, contacts and replans are sums.
std::vector<std::string> cells(const std::string& family, const std::string& tracks, const Drives& drives) {
  const sim::Totals& t = drives.totals;
  return {family,
          tracks,
          std::to_string(t.goals_reached) + " of " + std::to_string(t.goals_assigned),
          std::to_string(t.contacts_moving_vehicle),
          digits(t.least_clearance_m, 3),
          digits(t.distance_m / t.runs, 2),
          digits((t.distance_m - drives.planned_m) / t.runs, 2),
          digits(t.driven_s / t.runs, 1),
          std::to_string(t.replans)};
}

}  // namespace

/// The same seeds with and without prediction, so that only the tracks differ.
std::string detour_table(int seeds, const Progress& progress) {
  std::vector<std::vector<std::string>> table{{"family", "tracks", "goals", "contacts of a moving vehicle",
                                               "least clearance m", "length m", "beyond the plan m", "time s",
                                               "new plans"}};

  Drives predicted;
  Drives held_still;

  for (const char* family : {"person-crossing", "person-oncoming", "overtaking", "crowd"}) {
    progress(std::string("tracking: detours, ") + family);

    try {
      const Drives with = drive(family, Perception::kScans, seeds);
      const Drives without = drive(family, Perception::kScansHeldStill, seeds);

      table.push_back(cells(family, "predicted", with));
      table.push_back(cells(family, "held still", without));
      predicted.add(with);
      held_still.add(without);
    } catch (const config::BadInput&) {
      table.push_back({family, "left out: the recordings are not there", "", "", "", "", "", "", ""});
    }
  }

  if (predicted.totals.runs > 0) {
    table.push_back(cells("all", "predicted", predicted));
    table.push_back(cells("all", "held still", held_still));
  }

  return markdown_table(table);
}

}  // namespace aisle::lab
