// aisle fleet sign-off: a person's word that a silent vehicle drives no more, so that nobody waits for its.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "common/bus/topics.hpp"
#include "common/process/exit_code.hpp"
#include "common/service/hear.hpp"
#include "common/service/origin_stamper.hpp"
#include "tools/cli/cli.hpp"
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

bool is_silent(const LeadersWord& leader, const std::string& agv_id) {
  const auto& silent = leader.status().silent;
  return std::any_of(silent.begin(), silent.end(),
                     [&](const fleet::SilentVehicle& vehicle) { return vehicle.agv_id == agv_id; });
}

/// Says that the vehicle is signed off until the leader counts it among the silent no more.
int sign_off(const Cli& cli, const std::string& agv_id, double timeout_s) {
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

  if (!is_silent(leader, agv_id))
    return report_sign_off(cli, agv_id, "not_silent", agv_id + " is not among the silent vehicles: see aisle traffic",
                           process::kNegative);

  const auto is_done = [&] { return leader.is_there() && !is_silent(leader, agv_id); };
  for (Seconds left{timeout_s}; left > Seconds::zero() && !is_interrupted(); left -= kRepeatAfter) {
    auto sample = wire::encode(fleet::SignOff{agv_id, std::nullopt});
    sample.by(stamper.next());
    writer.write(sample);

    if (run_until(*bus, std::min(left, kRepeatAfter), is_done))
      return report_sign_off(cli, agv_id, "signed_off", agv_id + " is signed off, until it is heard again",
                             process::kDone);
  }

  return report_sign_off(cli, agv_id, "no_answer", "the leading planner did not confirm it", process::kEnvironment);
}

}  // namespace

void add_fleet_sign_off(CLI::App& parent, Cli& cli) {
  struct Options {
    std::string agv_id;
    double timeout_s{10.0};
  };

  auto options = std::make_shared<Options>();
  Verb(parent, cli, "sign-off",
       "say that a silent vehicle stands where it was heard last, or is gone; exit code 1 when it is not silent")
      .argument("agv", options->agv_id, "vehicle, e.g. agv-3")
      .option("--timeout", options->timeout_s, 0.1, 1e6, "give up after so many seconds")
      .runs([&cli, options] { return sign_off(cli, options->agv_id, options->timeout_s); });
}

}  // namespace aisle::cli
