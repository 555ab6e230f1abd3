// aisle map info: what aisle-map says of the site's map.

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "common/bus/topics.hpp"
#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/service/hear.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

/// What was heard of a map, and from whom.
struct SaidMap {
  grid::MapSummary summary;
  fleet::Origin by;
};

/// Their number instead, and the size in metres.
Json without_tile_hashes(const SaidMap& said) {
  const grid::Geometry& geometry = said.summary.tiling.geometry;
  Json json = json_of(said.summary, said.by);

  json["tiles"] = json["tile_hashes"].size();
  json["width_m"] = geometry.width * geometry.resolution_m;
  json["height_m"] = geometry.height * geometry.resolution_m;
  json.erase("tile_hashes");

  return json;
}

/// Every map that is seen until the first one is there.
int show_map(const Cli& cli, double timeout_s) {
  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-map-info");
  std::map<std::string, SaidMap> maps;

  service::hear<topics::MapInfo>(*bus, {[&](const grid::MapSummary& summary, const service::Sender& from) {
                                          maps[summary.map_id] = {summary, from.by};
                                        },
                                        {},
                                        {}});

  if (!run_until(*bus, Seconds(timeout_s), [&] { return !maps.empty(); })) {
    throw config::BadEnvironment("no map seen in " + place_of(cli.settings) +
                                 "; is aisle-map running? aisle doctor looks for the cause");
  }

  for (const auto& [id, said] : maps) {
    const Json json = without_tile_hashes(said);
    std::printf("%s", cli.json ? (write_json(json) + "\n").c_str() : text_of_sample(json, Length::kFull).c_str());
  }

  return process::kDone;
}

}  // namespace

void add_map_info(CLI::App& parent, Cli& cli) {
  auto timeout_s = std::make_shared<double>(3.0);
  Verb(parent, cli, "info", "id, revision, size, place and hash of the map")
      .option("--timeout", *timeout_s, 0.1, 1e6, "give up after so many seconds")
      .runs([&cli, timeout_s] { return show_map(cli, *timeout_s); });
}

}  // namespace aisle::cli
