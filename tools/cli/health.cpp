// aisle health: is one service ready? For healthchecks of containers.

#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/bus/topics.hpp"
#include "common/config/nearest_name.hpp"
#include "common/process/clock.hpp"
#include "common/process/exit_code.hpp"
#include "common/service/health_file.hpp"
#include "common/service/hear.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

constexpr double kLease_s = 3.0;  // a service speaks once a second; silent for as long as this, it hangs or is gone

/// Names the nearest service that was seen.
std::string text_of_absence(const Cli& cli, const std::string& instance_id, const std::set<std::string>& seen) {
  const std::string nearest = config::nearest_name(instance_id, {seen.begin(), seen.end()});
  return "no service '" + instance_id + "' seen in " + place_of(cli.settings) +
         (nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
}

/// The line for a person.
void print_word(const std::string& instance_id, const std::string& state, const std::string& waits_for,
                const std::string& last_error) {
  const std::string word = instance_id + ": " + state + (waits_for.empty() ? "" : ", waits for " + waits_for) +
                           (last_error.empty() ? "" : ", last error: " + last_error);
  std::printf("%s\n", printable(word).c_str());
}

/// Joins the site and waits until the service is ready.
int heard_health(const Cli& cli, const std::string& instance_id, double timeout_s) {
  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-health");
  std::optional<fleet::ServiceHealth> newest;
  fleet::Origin by;
  std::set<std::string> seen;

  service::hear<topics::ServiceHealth>(*bus, {[&](const fleet::ServiceHealth& health, const service::Sender& from) {
                                                seen.insert(health.instance_id);
                                                if (health.instance_id != instance_id) return;
                                                newest = health;
                                                by = from.by;
                                              },
                                              [&](const std::string& id, service::End) {
                                                if (id == instance_id) newest.reset();
                                              },
                                              {}});

  const bool is_ready =
      run_until(*bus, Seconds(timeout_s), [&] { return newest && newest->state == fleet::ServiceState::kReady; });
  if (cli.json) {
    std::printf("%s\n", newest ? write_json(json_of(*newest, by)).c_str() : "null");
  } else if (!newest) {
    std::fprintf(stderr, "%s\n", text_of_absence(cli, instance_id, seen).c_str());
  } else {
    print_word(instance_id, fleet::name(newest->state), newest->waits_for, newest->last_error);
  }

  return is_ready ? process::kDone : process::kNegative;
}

/// Reads the service's own file; what is older than the lease does not count.
int kept_health(const Cli& cli, const std::string& instance_id, const std::string& file) {
  const std::optional<service::HealthNote> note = service::recall_health(file);
  if (!note || note->instance_id != instance_id) {
    std::fprintf(stderr, "%s is not a health file of '%s'; is that service running with --health-file?\n", file.c_str(),
                 instance_id.c_str());
    return process::kNegative;
  }

  const double age_s = 1e-9 * static_cast<double>(process::wall_clock_ns() - note->wall_clock_ns);
  const bool is_fresh = age_s < kLease_s;

  if (cli.json) {
    std::printf("%s\n", write_json(Json{{"instance_id", instance_id},
                                        {"state", fleet::name(note->state)},
                                        {"waits_for", note->waits_for},
                                        {"last_error", note->last_error},
                                        {"age_s", age_s}})
                            .c_str());
  } else if (!is_fresh) {
    std::printf("%s: silent for %.1f s\n", printable(instance_id).c_str(), age_s);
  } else {
    print_word(instance_id, fleet::name(note->state), note->waits_for, note->last_error);
  }

  return is_fresh && note->state == fleet::ServiceState::kReady ? process::kDone : process::kNegative;
}

}  // namespace

void add_health(CLI::App& parent, Cli& cli) {
  struct Options {
    std::string instance_id, file;
    double timeout_s{3.0};
  };

  auto options = std::make_shared<Options>();

  Verb(parent, cli, "health", "exit code 0 when one service is ready, else 1: for healthchecks")
      .argument("instance", options->instance_id, "of the service, e.g. map or local-planner-agv-1")
      .option("--timeout", options->timeout_s, 0.1, 1e6, "how long to wait until it is ready, seconds")
      .option("--file", options->file, "do not join the site: read the service's own --health-file on this host")
      .runs([&cli, options] {
        return options->file.empty() ? heard_health(cli, options->instance_id, options->timeout_s)
                                     : kept_health(cli, options->instance_id, options->file);
      });
}

}  // namespace aisle::cli
