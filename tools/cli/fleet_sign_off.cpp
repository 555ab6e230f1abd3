// aisle fleet sign-off: a person's word that a silent vehicle drives no more, so that nobody waits for its.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/topics.hpp"
#include "common/process/exit_code.hpp"
#include "common/service/hear.hpp"
#include "common/service/origin_stamper.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/coordinates.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/text.hpp"
#include "tools/cli/traffic_view.hpp"

namespace aisle::cli {
namespace {

constexpr Seconds kUntilAPlannerLeads{3.0};
constexpr Seconds kRepeatAfter{0.5};

/// Prints the result and returns `code`.
int report_sign_off(const Cli& cli, const std::string& agv_id, const std::string& result, const std::string& text,
                    int code) {
  if (cli.json) {
    std::printf("%s\n", write_json(Json{{"agv_id", agv_id}, {"result", result}, {"text", text}}).c_str());
  } else {
    std::fprintf(code == process::kDone ? stdout : stderr, "%s\n", printable(text).c_str());
  }

  return code;
}

const fleet::SilentVehicle* find(const std::vector<fleet::SilentVehicle>& vehicles, const std::string& agv_id) {
  const auto found =
      std::find_if(vehicles.begin(), vehicles.end(), [&](const auto& vehicle) { return vehicle.agv_id == agv_id; });
  return found == vehicles.end() ? nullptr : &*found;
}

/// Is the vehicle signed off, and at the place that the person named, if any?
bool is_signed_off(const LeadersWord& leader, const fleet::SignOff& said) {
  const fleet::SilentVehicle* vehicle = find(leader.status().signed_off, said.agv_id);
  return vehicle != nullptr && (!said.place_in_map || vehicle->place_in_map == *said.place_in_map);
}

std::string told(const fleet::SignOff& said, geometry::Point2 place_in_map) {
  return said.place_in_map
             ? fmt::format("{} is signed off until it is heard again; it holds its place at ({:.2f}, {:.2f})",
                           said.agv_id, place_in_map.x, place_in_map.y)
             : fmt::format(
                   "{} is signed off until it is heard again; it was heard last at ({:.2f}, {:.2f}), and holds all "
                   "that "
                   "it could still drive from there: go and look; --at says where it stands",
                   said.agv_id, place_in_map.x, place_in_map.y);
}

/// Repeats the person's word until the leader shows it.
int sign_off(const Cli& cli, const fleet::SignOff& said, double timeout_s) {
  const std::string& agv_id = said.agv_id;
  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-sign-off");
  bus::Writer<topics::SignOff> writer = bus->writer<topics::SignOff>();
  service::OriginStamper stamper(*bus, "aisle", static_cast<std::uint64_t>(bus->wall_clock_ns()) / 1000);

  LeadersWord leader;
  service::hear<topics::TrafficStatus>(*bus,
                                       {[&](const fleet::TrafficStatus& status, const service::Sender& from) {
                                          leader.take(status, from.by, from.arrived);
                                        },
                                        [&](const std::string& source_id, service::End) { leader.lose(source_id); },
                                        {}});

  if (!run_until(*bus, kUntilAPlannerLeads, [&] { return leader.is_there(); }))
    return report_sign_off(cli, agv_id, "no_answer", "no leading aisle-global-planner is heard", process::kEnvironment);

  const auto is_known = [&] {
    return find(leader.status().silent, agv_id) != nullptr || find(leader.status().signed_off, agv_id) != nullptr;
  };
  if (!is_known())
    return report_sign_off(cli, agv_id, "not_silent", agv_id + " is not among the silent vehicles: see aisle traffic",
                           process::kNegative);

  const auto is_done = [&] { return leader.is_there() && (is_signed_off(leader, said) || !is_known()); };
  for (Seconds left{timeout_s}; left > Seconds::zero() && !is_interrupted(); left -= kRepeatAfter) {
    auto sample = wire::encode(said);
    sample.by(stamper.next());
    writer.write(sample);
    if (!run_until(*bus, std::min(left, kRepeatAfter), is_done)) continue;

    if (!is_signed_off(leader, said))
      return report_sign_off(cli, agv_id, "heard", agv_id + " is heard again, and was not signed off",
                             process::kNegative);

    return report_sign_off(cli, agv_id, "signed_off",
                           told(said, find(leader.status().signed_off, agv_id)->place_in_map), process::kDone);
  }

  return report_sign_off(cli, agv_id, "no_answer", "the leading planner did not confirm it", process::kEnvironment);
}

}  // namespace

void add_fleet_sign_off(CLI::App& parent, Cli& cli) {
  struct Options {
    std::string agv_id;
    std::string at;
    double timeout_s{10.0};
  };

  auto options = std::make_shared<Options>();
  Verb(parent, cli, "sign-off",
       "say that a silent vehicle drives no more: nobody waits for its word; exit code 1 when it is not silent")
      .argument("agv", options->agv_id, "vehicle, e.g. agv-3")
      .option("--at", options->at, "X,Y where it stands (m): all else that it holds is free; default: it holds that")
      .option("--timeout", options->timeout_s, 0.1, 1e6, "give up after so many seconds")
      .runs([&cli, options] {
        fleet::SignOff said{options->agv_id, std::nullopt};
        if (!options->at.empty()) said.place_in_map = parse_pose("--at", options->at).in_map.position();
        return sign_off(cli, said, options->timeout_s);
      });
}

}  // namespace aisle::cli
