#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/scenario/scenario.hpp"
#include "common/scenario/variation.hpp"
#include "common/service/run_service.hpp"
#include "services/fake-vehicle/fake_vehicle_service.hpp"

namespace {

using namespace aisle;

/// What the command line says beside the config file; a value that is absent leaves the scenario's or the file's.
struct Flags {
  std::string scenario_file;
  std::vector<double> start;  // x, y in metres and, if given, yaw in rad, in map
  std::optional<double> radius_m;
  std::optional<std::uint64_t> seed;
  std::string state_file;
};

/// The scenario's vehicle of this id. @throws config::BadInput, which lists those that there are
const scenario::Vehicle& find_vehicle(const scenario::Scenario& scenario, const std::string& agv_id) {
  const auto found = std::find_if(scenario.vehicles.begin(), scenario.vehicles.end(),
                                  [&](const scenario::Vehicle& v) { return v.id == agv_id; });
  if (found != scenario.vehicles.end()) return *found;

  std::string ids;
  for (const scenario::Vehicle& vehicle : scenario.vehicles) ids += (ids.empty() ? "" : ", ") + vehicle.id;
  throw config::BadInput("--agv: no vehicle '" + agv_id + "' in scenario " + scenario.name + "; it has " + ids);
}

/// Place, outline and limits from the scenario.
void start_by_scenario(const Flags& flags, const std::string& agv_id, fake_vehicle::ServiceConfig& config) {
  const scenario::Scenario scenario = scenario::read_scenario(flags.scenario_file);
  const scenario::Vehicle& vehicle = find_vehicle(scenario, agv_id);
  config.seed = flags.seed.value_or(scenario.seed);
  config.start_in_map = scenario::varied_start(vehicle, scenario.start_jitter_m, config.seed);

  if (flags.radius_m && !vehicle.footprint().is_disc())
    throw config::BadInput("--radius: " + agv_id + " of scenario " + scenario.name + " is a rectangle");

  config.vehicle.radius_m = flags.radius_m.value_or(vehicle.radius_m);
  config.vehicle.length_m = vehicle.length_m;
  config.vehicle.width_m = vehicle.width_m;
  config.vehicle.ahead_m = vehicle.ahead_m;
  config.vehicle.limits.max_speed_mps = vehicle.max_speed_mps;
  config.vehicle.limits.model = vehicle.kinematic_model();
  config.vehicle.limits.axle = vehicle.axle;

  config.run = scenario.name + "/" + agv_id + "/" + std::to_string(config.seed);
}

/// Place from `--start`; outline and limits stay as the config file has them, but for `--radius`.
void start_by_flags(const Flags& flags, const std::string& agv_id, fake_vehicle::ServiceConfig& config) {
  if (flags.start.empty())
    throw config::BadInput("--start X,Y,YAW or --scenario FILE is missing: where does the vehicle stand?");

  if (flags.start.size() < 2) throw config::BadInput("--start takes X,Y or X,Y,YAW: metres and radians in map");

  config.start_in_map = {flags.start[0], flags.start[1], flags.start.size() > 2 ? geometry::wrap(flags.start[2]) : 0.0};

  config.seed = flags.seed.value_or(config.seed);
  config.vehicle.radius_m = flags.radius_m.value_or(config.vehicle.radius_m);
  config.run = "start/" + agv_id;
}

/// The state file of this vehicle. When the process simulates several, each has its own: "x/fake.state" becomes
/// "x/fake-agv-1.state" for agv-1.
std::filesystem::path state_file_of(const Flags& flags, const service::Shell& shell) {
  std::filesystem::path file = flags.state_file;
  if (file.empty() || shell.is_alone()) return file;

  return file.replace_filename(file.stem().string() + "-" + shell.agv_id() + file.extension().string());
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  fake_vehicle::ServiceConfig config;

  const auto options = [&](CLI::App& app) {
    service::bind_config(config);
    app.add_option("--scenario", flags.scenario_file, "scenario that has this vehicle")->envname("AISLE_SCENARIO");
    app.add_option("--start", flags.start, "X,Y,YAW in map, instead of a scenario")
        ->delimiter(',')
        ->expected(2, 3)
        ->check(CLI::Number);
    app.add_option("--radius", flags.radius_m, "of the vehicle, in metres")->check(CLI::Range(0.05, 5.0));
    app.add_option("--seed", flags.seed, "of the noise and the start; default: the scenario's")->envname("AISLE_SEED");
    app.add_option("--state-file", flags.state_file,
                   "keeps the vehicle's place over a restart; of several vehicles one file each, FILE-<agv>");
  };

  return service::run_service(
      argc, argv, {"fake-vehicle", "Simulates vehicles with their lidars", "--agv"}, options,
      [&](service::Shell& shell) {
        fake_vehicle::ServiceConfig own = config;
        if (!flags.start.empty() && !shell.is_alone())
          throw config::BadInput("--start is the place of one vehicle; with several, give --scenario FILE");

        if (!flags.start.empty() || flags.scenario_file.empty()) {
          start_by_flags(flags, shell.agv_id(), own);
        } else {
          start_by_scenario(flags, shell.agv_id(), own);
        }

        own.state_file = state_file_of(flags, shell);
        return std::make_unique<fake_vehicle::FakeVehicleService>(shell, own);
      });
}
