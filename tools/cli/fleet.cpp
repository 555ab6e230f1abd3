// aisle fleet: a live table of the vehicles and of the services behind them.

#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>

#include "common/process/exit_code.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/fleet_view.hpp"

namespace aisle::cli {
namespace {

/// The flags with their defaults.
struct FleetOptions {
  bool once{false};
  double wait_s{2.0};
};

constexpr Seconds kRefresh{0.5};

/// One snapshot; in a terminal a picture that is drawn anew twice a second.
int fleet(const Cli& cli, const FleetOptions& options) {
  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-fleet");
  FleetView view;

  view.watch(*bus);

  const bool is_live = !options.once && !cli.json && isatty(STDOUT_FILENO) != 0;
  if (!is_live) {
    run_until(*bus, Seconds(options.wait_s), [] { return false; });

    const Json snapshot = view.snapshot(bus->now());
    if (cli.json) {
      std::printf("%s\n", write_json(snapshot).c_str());
    } else if (!view.empty()) {
      std::printf("%s", text_of_fleet(snapshot).c_str());
    }
  }

  while (is_live && !is_interrupted()) {
    run_until(*bus, kRefresh, [] { return false; });
    std::printf("\x1b[H\x1b[J%s\n%s\n", place_of(cli.settings).c_str(),
                text_of_fleet(view.snapshot(bus->now())).c_str());
    std::fflush(stdout);
  }

  if (view.has_vehicles()) return process::kDone;

  std::fprintf(stderr, "no vehicle seen in %s; aisle doctor looks for the cause\n", place_of(cli.settings).c_str());
  return process::kNegative;
}

}  // namespace

void add_fleet(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<FleetOptions>();
  Verb(parent, cli, "fleet", "vehicles and services, live in a terminal; exit code 1 when no vehicle was seen")
      .flag("--once", options->once, "one snapshot")
      .option("--wait", options->wait_s, 0.0, 3600.0, "seconds to look before a snapshot")
      .runs([&cli, options] { return fleet(cli, *options); });
}

}  // namespace aisle::cli
