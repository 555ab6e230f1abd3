// aisle health: is one service ready? For healthchecks of containers.
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/bus/topics.hpp"
#include "common/config/nearest_name.hpp"
#include "common/process/exit_code.hpp"
#include "tools/aisle/cli.hpp"
#include "tools/aisle/json/json.hpp"
#include "tools/aisle/text.hpp"

namespace aisle::cli {
namespace {

std::string text_of_absence(const Cli& cli, const std::string& instance_id, const std::set<std::string>& seen) {
  const std::string nearest = config::nearest_name(instance_id, {seen.begin(), seen.end()});
  return "no service '" + instance_id + "' seen in " + place_of(cli.settings) + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
}

int health(const Cli& cli, const std::string& instance_id, double timeout_s) {
  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-health");
  std::optional<aisle::ServiceHealth> newest;
  std::set<std::string> seen;
  bus->on<topics::ServiceHealth>([&](const aisle::ServiceHealth& sample, const bus::SampleInfo& info) {
    const std::string id = sample.instance_id().to_string();
    if (info.kind == bus::SampleKind::kData) seen.insert(id);
    if (id != instance_id) return;
    newest = info.kind == bus::SampleKind::kData ? std::optional<aisle::ServiceHealth>(sample) : std::nullopt;
  });
  const bool is_ready = run_until(*bus, Seconds(timeout_s), [&] { return newest && newest->state() == ServiceState::SERVICE_READY; });
  if (cli.json) {
    std::printf("%s\n", newest ? write_json(to_json(*newest)).c_str() : "null");
  } else if (!newest) {
    std::fprintf(stderr, "%s\n", text_of_absence(cli, instance_id, seen).c_str());
  } else {
    const std::string waits_for = newest->waits_for().to_string();
    const std::string last_error = newest->last_error().to_string();
    std::printf("%s\n", printable(instance_id + ": " + name_of(newest->state()) + (waits_for.empty() ? "" : ", waits for " + waits_for) +
                                  (last_error.empty() ? "" : ", last error: " + last_error))
                            .c_str());
  }
  return is_ready ? process::kDone : process::kNegative;
}

}  // namespace

void add_health(CLI::App& parent, Cli& cli) {
  struct Options {
    std::string instance_id;
    double timeout_s{3.0};
  };
  auto options = std::make_shared<Options>();
  Verb(parent, cli, "health", "exit code 0 when one service is ready, else 1: for healthchecks")
      .argument("instance", options->instance_id, "of the service, e.g. map or local-planner-agv-1")
      .option("--timeout", options->timeout_s, 0.1, 1e6, "how long to wait until it is ready, seconds")
      .runs([&cli, options] { return health(cli, options->instance_id, options->timeout_s); });
}

}  // namespace aisle::cli
