#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "common/scenario/scenario.hpp"
#include "services/fake-vehicle/core/parameters.hpp"
#include "services/fake-world/core/recording.hpp"
#include "services/global-planner/core/fleet_types.hpp"
#include "services/global-planner/core/parameters.hpp"
#include "services/local-planner/core/local_planner.hpp"

namespace aisle::sim {

/// Where the fleet's knowledge of people and things comes from: from simulated scans and the tracker;
/// the same, but every track held still (nothing is predicted); or the truth of what is in sight.
enum class Perception { kScans, kScansHeldStill, kTruth };

/// Everything that decides a run, beside its faults.
struct Setup {
  scenario::Scenario scenario;  // its map and its recordings come beside it, read
  grid::OccupancyGrid grid;
  std::vector<std::vector<fake_world::RecordedPerson>> people;  // of each recording
  fake_vehicle::Parameters vehicle;                             // radius and top speed come from the scenario
  Perception perception{Perception::kScans};
  std::string only_scans_of{};                          // the one vehicle whose scans the tracker takes; empty: all
  std::string planner{"direct"};                        // a variant of the global planner
  std::string local{"wang"};                            // of the local planner
  std::optional<local_planner::Variant> own_variant{};  // instead of `local`
  bool paper_limits{false};                             // vehicles and horizon as in the paper of `local`
  bool as_printed{false};  // planners, outline and arrival too: with nothing of ours between the paper's parts
  local_planner::Settings settings;
  std::uint64_t seed{1};
  global_planner::Parameters planner_parameters{};  // of `planner`; those that are not set are as published
  global_planner::FleetSettings fleet{};            // of the global planner
  bool has_standby_planner{false};                  // a second global planner, "global-planner-standby"
};

}  // namespace aisle::sim
