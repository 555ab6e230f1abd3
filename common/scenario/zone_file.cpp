#include "common/scenario/zone_file.hpp"

#include <cstdio>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace aisle::scenario {
namespace {

using config::YamlReader;

// The value's own limits are narrower and are told by it; these keep infinities and typing errors out.
constexpr double kFarthestM = 1.0e6;

/// One zone. `where`: file and line of its id.
struct ZoneEntry {
  fleet::Zone value;
  std::string where;

  void describe(YamlReader& r) {
    std::string kind;
    r.field("id", value.id)
        .field("kind", kind)
        .field("max_speed_mps", value.max_speed_mps, -kFarthestM, kFarthestM)
        .field("direction_rad", value.direction_rad, -kFarthestM, kFarthestM)
        .require({"id", "kind"});

    const char* const shape_key = read_shape(r);
    if (!r.has("id") || !r.has("kind")) return;

    const auto known = fleet::find_zone_kind(kind);
    if (!known) {
      r.reject("kind", "'" + kind + "' is no kind; use keep-out, speed, one-way, no-stopping, one-vehicle or parking");
    }

    value.kind = *known;
    if (*known == fleet::Zone::Kind::kSpeed) r.require({"max_speed_mps"});
    if (*known == fleet::Zone::Kind::kOneWay) r.require({"direction_rad"});
    where = r.where("id");

    check(r, shape_key);
  }

 private:
  /// Exactly one of the three. @returns its key
  const char* read_shape(YamlReader& r) {
    std::vector<double> rectangle;
    std::vector<double> disc;
    std::vector<std::vector<double>> polygon;
    r.field("rectangle", rectangle, -kFarthestM, kFarthestM)
        .field("disc", disc, -kFarthestM, kFarthestM)
        .field("polygon", polygon, -kFarthestM, kFarthestM);

    if (int{r.has("rectangle")} + int{r.has("disc")} + int{r.has("polygon")} != 1)
      r.reject("id", "takes one shape: rectangle, polygon or disc");

    if (r.has("rectangle")) {
      if (rectangle.size() != 4) r.reject("rectangle", "takes [x1, y1, x2, y2]: two opposite corners, metres in map");
      value.points_in_map = {{rectangle[0], rectangle[1]}, {rectangle[2], rectangle[3]}};
      return "rectangle";
    }

    if (r.has("disc")) {
      if (disc.size() != 3) r.reject("disc", "takes [x, y, radius]: centre and radius, metres in map");
      value.shape = fleet::Zone::Shape::kDisc;
      value.points_in_map = {{disc[0], disc[1]}};
      value.radius_m = disc[2];
      return "disc";
    }

    value.shape = fleet::Zone::Shape::kPolygon;
    for (const std::vector<double>& row : polygon) {
      if (row.size() != 2) r.reject("polygon", "takes corners [x, y]: metres in map");
      value.points_in_map.push_back({row[0], row[1]});
    }

    return "polygon";
  }

  /// What the value says, at the key that it is about: reasons begin with the field.
  void check(YamlReader& r, const char* shape_key) const {
    const std::string reason = fleet::refusal_of(value);
    if (reason.empty()) return;

    const auto is_about = [&reason](const char* field) { return reason.rfind(field, 0) == 0; };
    const char* key = "id";
    if (is_about("points") || is_about("radius_m")) key = shape_key;
    if (is_about("max_speed_mps")) key = "max_speed_mps";
    if (is_about("direction_rad")) key = "direction_rad";

    r.reject(key, reason);
  }
};

/// The whole of a file of zones.
struct ZoneFile {
  std::vector<fleet::Zone> zones;

  void describe(YamlReader& r) {
    r.require({"zones"});
    read_zones(r, "zones", zones);
  }
};

/// With as many digits as it takes to read the same number again.
std::string text(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof(buffer), "%.17g", value);

  char shorter[40];
  std::snprintf(shorter, sizeof(shorter), "%.12g", value);

  return std::stod(shorter) == value ? shorter : buffer;
}

std::string text(geometry::Point2 point) { return text(point.x) + ", " + text(point.y); }

/// "rectangle: [1, 2, 4, 5]"
std::string text_of_shape(const fleet::Zone& zone) {
  const auto& points = zone.points_in_map;

  switch (zone.shape) {
    case fleet::Zone::Shape::kRectangle:
      return "rectangle: [" + text(points[0]) + ", " + text(points[1]) + "]";
    case fleet::Zone::Shape::kDisc:
      return "disc: [" + text(points[0]) + ", " + text(zone.radius_m) + "]";
    case fleet::Zone::Shape::kPolygon:
      break;
  }

  std::string corners;
  for (const geometry::Point2 point : points) corners += (corners.empty() ? "[" : ", [") + text(point) + "]";

  return "polygon: [" + corners + "]";
}

}  // namespace

void read_zones(YamlReader& r, const char* key, std::vector<fleet::Zone>& zones) {
  std::vector<ZoneEntry> entries;
  r.list(key, entries);

  std::set<std::string> ids;
  for (const fleet::Zone& zone : zones) ids.insert(zone.id);

  for (ZoneEntry& entry : entries) {
    if (!ids.insert(entry.value.id).second)
      throw config::BadInput(entry.where + ": '" + entry.value.id + "' names two zones; give each its own id");
    zones.push_back(std::move(entry.value));
  }

  if (zones.size() > fleet::kMostZones) {
    r.reject(key,
             "make " + std::to_string(zones.size()) + " zones; a map may have " + std::to_string(fleet::kMostZones));
  }
}

std::vector<fleet::Zone> read_zone_file(const std::filesystem::path& file) {
  ZoneFile read;
  config::read_yaml_file(file, read);
  return std::move(read.zones);
}

std::filesystem::path zone_file_beside(const std::filesystem::path& map_file) {
  return map_file.parent_path() / (map_file.stem().string() + ".zones.yaml");
}

std::vector<fleet::Zone> read_zones_beside(const std::filesystem::path& map_file) {
  const std::filesystem::path file = zone_file_beside(map_file);
  std::error_code error;

  return std::filesystem::exists(file, error) ? read_zone_file(file) : std::vector<fleet::Zone>{};
}

std::string text_of_zones(const std::vector<fleet::Zone>& zones) {
  if (zones.empty()) return "zones: []\n";

  std::string lines = "zones:\n";
  for (const fleet::Zone& zone : zones) {
    // Ids that look like numbers stay texts.
    lines += "  - {id: \"" + zone.id + "\", kind: " + name(zone.kind);
    if (zone.kind == fleet::Zone::Kind::kSpeed) lines += ", max_speed_mps: " + text(zone.max_speed_mps);
    if (zone.kind == fleet::Zone::Kind::kOneWay) lines += ", direction_rad: " + text(zone.direction_rad);
    lines += ", " + text_of_shape(zone) + "}\n";
  }

  return lines;
}

}  // namespace aisle::scenario
