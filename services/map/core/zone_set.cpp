#include "services/map/core/zone_set.hpp"

#include <algorithm>
#include <utility>

#include "services/map/core/content_hash.hpp"

namespace aisle::map {
namespace {

bool has_lower_id(const fleet::Zone& a, const fleet::Zone& b) { return a.id < b.id; }

/// Does the box around the zone meet the grid's floor?
bool is_on_floor(const fleet::Zone& zone, const grid::Geometry& floor) {
  const std::vector<geometry::Point2> corners = fleet::corners_of(zone);
  const auto by_x = [](geometry::Point2 a, geometry::Point2 b) { return a.x < b.x; };
  const auto by_y = [](geometry::Point2 a, geometry::Point2 b) { return a.y < b.y; };
  const auto [left, right] = std::minmax_element(corners.begin(), corners.end(), by_x);
  const auto [lowest, highest] = std::minmax_element(corners.begin(), corners.end(), by_y);

  const geometry::Point2 low = floor.origin_in_map;
  const geometry::Point2 high = low + floor.resolution_m * geometry::Point2{double(floor.width), double(floor.height)};

  return right->x >= low.x && left->x <= high.x && highest->y >= low.y && lowest->y <= high.y;
}

}  // namespace

ZoneSet::ZoneSet(std::string map_id, std::vector<fleet::Zone> zones, std::uint64_t revision)
    : zones_{std::move(map_id), revision, std::move(zones)} {
  std::sort(zones_.zones.begin(), zones_.zones.end(), has_lower_id);
}

const fleet::Zone* ZoneSet::find(const std::string& id) const {
  const auto has_id = [&id](const fleet::Zone& zone) { return zone.id == id; };
  const auto at = std::find_if(zones_.zones.begin(), zones_.zones.end(), has_id);
  return at == zones_.zones.end() ? nullptr : &*at;
}

std::string ZoneSet::refusal_of(const fleet::ZoneEdit& edit, const grid::Geometry& floor) const {
  if (edit.edit_id.empty()) return "edit_id is empty";
  if (edit.map_id != zones_.map_id) return "map '" + edit.map_id + "' is not served here, '" + zones_.map_id + "' is";

  const bool is_known = find(edit.zone.id) != nullptr;
  if (edit.action == fleet::ZoneEdit::Action::kRemove)
    return is_known ? "" : "no zone '" + edit.zone.id + "' on this map: aisle map zone list shows all";

  std::string reason = fleet::refusal_of(edit.zone);
  if (!reason.empty()) return reason;

  if (is_known) return "zone '" + edit.zone.id + "' is on this map already: remove it first, or take another id";
  if (zones_.zones.size() >= fleet::kMostZones)
    return "the map has " + std::to_string(fleet::kMostZones) + " zones, the most allowed: remove one";

  return is_on_floor(edit.zone, floor) ? "" : "zone '" + edit.zone.id + "' lies outside the map";
}

void ZoneSet::apply(const fleet::ZoneEdit& edit, std::uint64_t revision) {
  std::vector<fleet::Zone>& zones = zones_.zones;
  const auto at = std::lower_bound(zones.begin(), zones.end(), edit.zone, has_lower_id);

  if (edit.action == fleet::ZoneEdit::Action::kAdd) {
    zones.insert(at, edit.zone);
  } else {
    zones.erase(at);
  }

  zones_.revision = revision;
}

std::uint64_t hash_of(const std::vector<fleet::Zone>& zones) {
  if (zones.empty()) return 0;

  std::vector<fleet::Zone> sorted = zones;
  std::sort(sorted.begin(), sorted.end(), has_lower_id);

  ContentHash hash;
  for (const fleet::Zone& zone : sorted) hash.mix(zone);

  return hash.value();
}

}  // namespace aisle::map
