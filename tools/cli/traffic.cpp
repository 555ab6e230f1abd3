// aisle traffic: which vehicle waits for which, since when and why; with --svg a picture of plans and grants.

#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/output_file.hpp"
#include "common/service/map_client.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/traffic_picture.hpp"
#include "tools/cli/traffic_view.hpp"

namespace aisle::cli {
namespace {

/// The flags with their defaults.
struct TrafficOptions {
  bool once{false};
  double wait_s{5.0};
  std::string svg;
};

constexpr Seconds kRedraw{0.5};
constexpr Seconds kUntilAllIsSaid{
    1.0};  // statuses come ten times a second; plans and grants as soon as their writer is known

/// A planner that does not lead says nothing of the traffic.
[[noreturn]] void refuse_without_leader(const Cli& cli) {
  throw config::BadEnvironment("no planner that leads traffic heard in " + place_of(cli.settings) +
                               "; is aisle-global-planner running? aisle doctor looks for the cause");
}

/// The picture of this moment.
void write_picture(const Cli& cli, bus::Bus& bus, const service::MapClient& map, const TrafficView& view,
                   const TrafficOptions& options) {
  if (!run_until(bus, Seconds(options.wait_s), [&] { return map.has_map(); }))
    throw config::BadEnvironment("no map seen in " + place_of(cli.settings) + "; is aisle-map running?");

  process::write_output_file(options.svg, traffic_svg(map.grid(), view.drawn(), map.zones()));
}

/// One snapshot; in a terminal a picture that is drawn anew twice a second.
int traffic(const Cli& cli, const TrafficOptions& options) {
  if (!options.svg.empty()) process::check_writable(options.svg);

  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-traffic");
  TrafficView view;
  view.watch(*bus);

  std::unique_ptr<service::MapClient> map;
  if (!options.svg.empty()) {
    service::MapClient::Options map_options;
    map_options.with_clearance = false;
    map = std::make_unique<service::MapClient>(*bus, unique_id("aisle-traffic"), map_options);
  }

  if (!run_until(*bus, Seconds(options.wait_s), [&] { return view.has_leader(); })) refuse_without_leader(cli);

  const bool is_live = !options.once && !cli.json && options.svg.empty() && isatty(STDOUT_FILENO) != 0;
  if (!is_live) {
    run_until(*bus, kUntilAllIsSaid, [] { return false; });
    if (map) write_picture(cli, *bus, *map, view, options);
    if (!view.has_leader()) refuse_without_leader(cli);

    const Json snapshot = view.snapshot(bus->now());
    std::printf("%s", cli.json ? (write_json(snapshot) + "\n").c_str() : text_of_traffic(snapshot).c_str());
  }

  while (is_live && !is_interrupted()) {
    run_until(*bus, kRedraw, [] { return false; });
    std::printf("\x1b[H\x1b[J%s\n%s", place_of(cli.settings).c_str(),
                view.has_leader() ? text_of_traffic(view.snapshot(bus->now())).c_str() : "no planner leads\n");
    std::fflush(stdout);
  }

  return process::kDone;
}

}  // namespace

void add_traffic(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<TrafficOptions>();
  Verb(parent, cli, "traffic", "which vehicle waits for which, since when and why; live in a terminal")
      .flag("--once", options->once, "one snapshot")
      .option("--wait", options->wait_s, 0.1, 3600.0, "give up after so many seconds without a leading planner")
      .option("--svg", options->svg, "draw the map with plans, grants and waits into this file")
      .runs([&cli, options] { return traffic(cli, *options); });
}

}  // namespace aisle::cli
