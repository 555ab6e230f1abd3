#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"

namespace aisle::demo {

/// One process of a run.
struct Process {
  std::string instance;  // "local-planner-agv-1", or "local-planner" of all vehicles; names its log
  std::string program;   // "aisle-local-planner"
  std::vector<std::string> arguments;
  double start_s{0.0};
  bool is_referee{false};
};

/// What the command line decides of a run.
struct RunSettings {
  std::filesystem::path scenario_file;
  std::filesystem::path out;            // made if missing
  std::filesystem::path config_folder;  // with <service>.yaml; those missing keep their defaults
  std::uint64_t seed{1};
  int domain{0};
  double timeout_s{300.0};
  bool reversed{false};  // the referee first, the map last
  bool together{false};  // one fake-vehicle and one local-planner for all vehicles, not one of each for each
};

/// The processes that drive this scenario, in the order of their start.
std::vector<Process> processes_of(const scenario::Scenario& scenario, const RunSettings& settings);

/// A scenario by name ("warehouse") or path. Names are looked up in deploy/scenarios of the working directory, of the
/// tree that this program was built in, and beside an installed program (../share/aisle). @throws config::BadInput
/// naming what there is
std::filesystem::path find_scenario(const std::string& name, const std::filesystem::path& program_folder);

}  // namespace aisle::demo
