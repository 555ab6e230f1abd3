#include "tools/demo/fleet.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"

namespace aisle::demo {
namespace {

namespace fs = std::filesystem;

using Arguments = std::vector<std::string>;

/// One process of the service `name`; `agv_id`: of its one vehicle, else empty.
Process service(const std::string& name, const std::string& agv_id, Arguments arguments, const RunSettings& settings) {
  Process process;
  process.instance = agv_id.empty() ? name : name + "-" + agv_id;
  process.program = "aisle-" + name;
  process.arguments = {"--domain",      std::to_string(settings.domain), "--interface", "127.0.0.1", "--instance",
                       process.instance};
  if (!agv_id.empty()) arguments.insert(arguments.end(), {"--agv", agv_id});

  const fs::path config = settings.config_folder / (name + ".yaml");
  const bool takes_config = name != "map";  // its file names a map, and so does the scenario

  if (takes_config && !settings.config_folder.empty() && fs::is_regular_file(config))
    arguments.insert(arguments.end(), {"--config", config.string()});

  process.arguments.insert(process.arguments.end(), arguments.begin(), arguments.end());
  return process;
}

/// The processes that simulate and drive the vehicles.
std::vector<Process> vehicle_processes(const scenario::Scenario& scenario, const RunSettings& settings) {
  const auto fake_vehicle = [&](const std::string& kept) {
    return Arguments{"--scenario",   settings.scenario_file.string(),         "--seed", std::to_string(settings.seed),
                     "--state-file", (settings.out / "state" / kept).string()};
  };

  std::vector<Process> all;
  if (settings.together && scenario.vehicles.size() > 1) {
    std::vector<std::string> ids;
    for (const scenario::Vehicle& vehicle : scenario.vehicles) ids.push_back(vehicle.id);

    const std::string together = fmt::format("{}", fmt::join(ids, ","));
    Arguments of_fakes = fake_vehicle("fake-vehicle.state");

    of_fakes.insert(of_fakes.end(), {"--agv", together});
    all.push_back(service("fake-vehicle", "", std::move(of_fakes), settings));
    all.push_back(service("local-planner", "", {"--agv", together}, settings));

    return all;
  }

  for (const scenario::Vehicle& vehicle : scenario.vehicles) {
    all.push_back(service("fake-vehicle", vehicle.id, fake_vehicle("fake-vehicle-" + vehicle.id + ".state"), settings));
    all.push_back(service("local-planner", vehicle.id, {}, settings));
  }

  return all;
}

/// Best first.
std::vector<fs::path> scenario_folders(const fs::path& program_folder) {
  return {fs::current_path() / "deploy/scenarios", (program_folder / "../../deploy/scenarios").lexically_normal(),
          (program_folder / "../share/aisle/deploy/scenarios").lexically_normal()};
}

/// Scenarios of a folder, in alphabetical order.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code missing;

  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }

  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

/// The map first, so that the others find it; the referee before all, so that it sees everything.
std::vector<Process> processes_of(const scenario::Scenario& scenario, const RunSettings& settings) {
  const std::string file = settings.scenario_file.string();
  const std::string seed = std::to_string(settings.seed);
  const auto kept = [&](const std::string& name) { return (settings.out / "state" / name).string(); };
  std::vector<Process> all;

  all.push_back(service("map", "", {"--scenario", file, "--journal", kept("map.sqlite")}, settings));
  all.push_back(service("global-planner", "", {}, settings));
  all.push_back(service("obstacle-tracker", "", {}, settings));
  all.push_back(service("fake-world", "",
                        {"--scenario", file, "--seed", seed, "--state-file", kept("fake-world.state")}, settings));
  for (Process& process : vehicle_processes(scenario, settings)) all.push_back(std::move(process));
  all.push_back(service("dispatcher", "", {"--scenario", file, "--state-file", kept("dispatcher.state")}, settings));

  Process referee = service("referee", "",
                            {"--scenario", file, "--seed", seed, "--out", settings.out.string(), "--progress-json",
                             "--duration", fmt::format("{:.1f}", settings.timeout_s)},
                            settings);
  referee.is_referee = true;
  all.insert(all.begin(), std::move(referee));  // sees all from the start
  if (settings.reversed) std::reverse(all.begin() + 1, all.end());

  return all;
}

/// A path as it is; a name in the folders, best first.
fs::path find_scenario(const std::string& name, const fs::path& program_folder) {
  if (fs::is_regular_file(name)) return fs::absolute(name).lexically_normal();

  std::vector<std::string> known;
  for (const fs::path& folder : scenario_folders(program_folder)) {
    const fs::path file = folder / (name + ".yaml");
    if (fs::is_regular_file(file)) return file;

    for (std::string& other : names_in(folder)) {
      if (std::find(known.begin(), known.end(), other) == known.end()) known.push_back(std::move(other));
    }
  }

  const std::string near = config::nearest_name(name, known);
  throw config::BadInput(fmt::format("no scenario '{}'{}; there are: {}; or give the path of a file", name,
                                     near.empty() ? "" : ", did you mean '" + near + "'",
                                     known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

}  // namespace aisle::demo
