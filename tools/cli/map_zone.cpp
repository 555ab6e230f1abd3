// aisle map zone list, add, remove: the zones of the site's map.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/topics.hpp"
#include "common/config/reader.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/output_file.hpp"
#include "common/scenario/scenario.hpp"
#include "common/service/map_client.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/coordinates.hpp"
#include "tools/cli/edit_shape.hpp"
#include "tools/cli/edit_talk.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/text.hpp"
#include "tools/draw/zones.hpp"

namespace aisle::cli {
namespace {

/// The flags of list with their defaults.
struct ListOptions {
  std::string scenario;
  std::string svg;
  std::string map_id;
  double timeout_s{5.0};
};

/// Where the zone lies: "1,2 to 4,5".
std::string text_of_place(const fleet::Zone& zone) {
  const auto& points = zone.points_in_map;

  switch (zone.shape) {
    case fleet::Zone::Shape::kRectangle:
      return fmt::format("{:g},{:g} to {:g},{:g}", points[0].x, points[0].y, points[1].x, points[1].y);
    case fleet::Zone::Shape::kDisc:
      return fmt::format("{:g} m around {:g},{:g}", zone.radius_m, points[0].x, points[0].y);
    case fleet::Zone::Shape::kPolygon:
      break;
  }

  return fmt::format("{} corners from {:g},{:g}", points.size(), points[0].x, points[0].y);
}

/// What only its kind has; "-" for none.
std::string text_of_rule(const fleet::Zone& zone) {
  if (zone.kind == fleet::Zone::Kind::kSpeed) return fmt::format("{:g} m/s", zone.max_speed_mps);
  if (zone.kind == fleet::Zone::Kind::kOneWay) return fmt::format("{:g} rad", zone.direction_rad);
  return "-";
}

int print_zones(const Cli& cli, const fleet::MapZones& zones) {
  if (cli.json) {
    Json json = to_json(wire::encode(zones));
    json.erase("by");
    std::printf("%s\n", write_json(json).c_str());
    return process::kDone;
  }

  std::vector<std::vector<std::string>> rows{{"ZONE", "KIND", "RULE", "WHERE_M"}};
  for (const fleet::Zone& zone : zones.zones)
    rows.push_back({zone.id, name(zone.kind), text_of_rule(zone), text_of_place(zone)});

  std::printf("%s", zones.zones.empty() ? "no zones\n" : text_of_table(rows).c_str());
  return process::kDone;
}

/// Those that a scenario's site begins with, without a site.
int list_of_scenario(const Cli& cli, const ListOptions& options) {
  scenario::Scenario scenario = scenario::read_scenario(options.scenario);
  if (!options.svg.empty()) {
    const grid::OccupancyGrid grid = grid::read_map_file(scenario.map_file, scenario.map_options);
    process::write_output_file(options.svg, draw::zones_picture(grid, scenario.zones));
  }

  return print_zones(cli, {scenario.map_file.stem().string(), 1, std::move(scenario.zones)});
}

/// Those of the site.
int list_zones(const Cli& cli, const ListOptions& options) {
  if (!options.svg.empty()) process::check_writable(options.svg);
  if (!options.scenario.empty()) return list_of_scenario(cli, options);

  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-map-zones");
  service::MapClient::Options client_options;
  client_options.map_id = options.map_id;
  client_options.with_clearance = false;
  service::MapClient map(*bus, unique_id("aisle-map-zones"), client_options);

  const bool needs_cells = !options.svg.empty();
  const auto is_done = [&] { return map.has_zones() && (!needs_cells || (map.has_map() && map.is_complete())); };
  if (!run_until(*bus, Seconds(options.timeout_s), is_done)) {
    throw config::BadEnvironment(
        fmt::format("no zones of a map heard within {:g} s in {}; is aisle-map running? aisle "
                    "doctor looks for the cause",
                    options.timeout_s, place_of(cli.settings)));
  }

  if (needs_cells) process::write_output_file(options.svg, draw::zones_picture(map.grid(), map.zones()));

  return print_zones(cli, map.all_zones());
}

/// The flags of add and remove with their defaults.
struct EditOptions {
  std::string zone_id;
  std::string kind;
  TypedShape shape;
  std::string speed;
  std::string direction;
  std::string edit_id;
  std::string map_id;
  double timeout_s{10.0};
};

/// @throws config::BadInput when it is no zone: the reason names what is wrong
fleet::Zone zone_of(const EditOptions& options) {
  const auto kind = fleet::find_zone_kind(options.kind);
  if (!kind) {
    throw config::BadInput("'" + options.kind +
                           "' is no kind of zone; use keep-out, speed, one-way, no-stopping, one-vehicle or parking");
  }

  fleet::Zone zone;
  zone.id = options.zone_id;
  zone.kind = *kind;

  fleet::MapEdit drawn;
  set_shape(options.shape, drawn);
  zone.shape = drawn.shape;
  zone.points_in_map = drawn.points_in_map;
  zone.radius_m = drawn.radius_m;

  if (!options.speed.empty())
    zone.max_speed_mps = parse_numbers("--speed", options.speed, 1, "--speed 0.4 (metres a second)")[0];
  if (!options.direction.empty())
    zone.direction_rad = parse_numbers("--direction", options.direction, 1, "--direction 1.57 (radians, in map)")[0];
  if (*kind == fleet::Zone::Kind::kSpeed && options.speed.empty())
    throw config::BadInput("a speed zone needs --speed, metres a second");
  if (*kind == fleet::Zone::Kind::kOneWay && options.direction.empty())
    throw config::BadInput("a one-way zone needs --direction, radians from the map's x axis");

  const std::string reason = fleet::refusal_of(zone);
  if (!reason.empty()) throw config::BadInput("zone '" + zone.id + "': " + reason);

  return zone;
}

int edit_zones(const Cli& cli, const EditOptions& options, fleet::ZoneEdit::Action action) {
  const bool is_added = action == fleet::ZoneEdit::Action::kAdd;
  fleet::ZoneEdit edit;
  edit.edit_id = options.edit_id.empty() ? unique_id("aisle") : options.edit_id;
  edit.action = action;
  edit.zone.id = options.zone_id;
  if (is_added) edit.zone = zone_of(options);

  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-map-edit");
  const EditTalk::Answer answer = EditTalk(*bus).apply(edit, options.map_id, options.timeout_s);

  return print_result(cli, answer, fmt::format("zone {} is {}", options.zone_id, is_added ? "added" : "removed"));
}

/// The flags that add and remove share.
Verb& add_edit_flags(Verb& verb, EditOptions& options) {
  return verb.option("--id", options.edit_id, "id of the edit: the same id is applied once; one is made when not given")
      .option("--map", options.map_id, "id of the map; the one that is seen when not given")
      .option("--timeout", options.timeout_s, 0.1, 1e6, "give up after so many seconds");
}

}  // namespace

void add_map_zone_list(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<ListOptions>();
  Verb(parent, cli, "list", "all zones of the map")
      .option("--scenario", options->scenario, "those of this scenario file; no site is needed")
      .option("--svg", options->svg, "draw the map with its zones into this file")
      .option("--map", options->map_id, "id of the map; the one that is seen when not given")
      .option("--timeout", options->timeout_s, 0.1, 1e6, "give up after so many seconds")
      .runs([&cli, options] { return list_zones(cli, *options); });
}

void add_map_zone_add(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<EditOptions>();
  Verb verb(parent, cli, "add", "add a zone to the map; exit code 1 when it is refused");
  verb.argument("ID", options->zone_id, "name of the zone: letters, digits, '-', '_' and '.'")
      .argument("KIND", options->kind, "keep-out, speed, one-way, no-stopping, one-vehicle or parking")
      .option("--rect", options->shape.rectangle, "x1,y1,x2,y2: two opposite corners, metres")
      .option("--disc", options->shape.disc, "x,y,radius: metres")
      .list("--polygon", options->shape.polygon, "x,y x,y x,y ...: 3 to 64 corners, metres")
      .option("--speed", options->speed, "of a speed zone: at most so many metres a second, 0.05 to 10")
      .option("--direction", options->direction, "of a one-way zone: radians from the map's x axis, -6.3 to 6.3");
  add_edit_flags(verb, *options).runs([&cli, options] {
    return edit_zones(cli, *options, fleet::ZoneEdit::Action::kAdd);
  });
}

void add_map_zone_remove(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<EditOptions>();
  Verb verb(parent, cli, "remove", "remove a zone from the map; exit code 1 when it is refused");
  verb.argument("ID", options->zone_id, "name of the zone; aisle map zone list shows all");
  add_edit_flags(verb, *options).runs([&cli, options] {
    return edit_zones(cli, *options, fleet::ZoneEdit::Action::kRemove);
  });
}

}  // namespace aisle::cli
