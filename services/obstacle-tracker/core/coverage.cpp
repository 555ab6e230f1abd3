#include "services/obstacle-tracker/core/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/kinematics/vehicle_model.hpp"

namespace aisle::obstacle_tracker {
namespace {

using geometry::Point2;

constexpr time::Stamp kNever = time::Stamp::min();
constexpr double kTurn_rad = 2.0 * geometry::kPi;

/// The number of coarse cells that cover so many fine ones.
int coarse_cells(int cells, double resolution_m, double coarse_m) {
  return static_cast<int>(std::ceil(cells * resolution_m / coarse_m - 1e-9));
}

}  // namespace

std::uint8_t age_code(time::Stamp seen, time::Stamp now) {
  if (seen == kNever) return kNeverSeen;

  const double steps = std::ceil(std::max(0.0, time::seconds(now - seen)) / kAgeStep_s);
  return steps < kSeenLongAgo ? static_cast<std::uint8_t>(steps) : kSeenLongAgo;
}

/// One scan, made ready to be asked about many places.
struct Coverage::Look {
  explicit Look(const Scan& scan) : stamp(scan.stamp), goes_around(is_full_turn(scan)), far_m(scan.range_max_m) {
    const auto middle = kinematics::advance(scan.base_in_map, scan.twist, 0.5 * scan.sweep_s);
    from_in_map = middle.position();

    const double rays = static_cast<double>(scan.ranges_m.size());
    first_rad = scan.base_in_map.yaw + scan.first_angle_rad;

    // The vehicle turns while it scans: the rays lie wider apart, or closer.
    step_rad = scan.angle_step_rad + (rays > 1.0 ? scan.twist.angular_radps * scan.sweep_s / (rays - 1.0) : 0.0);

    free_m.reserve(scan.ranges_m.size());

    for (const float range_m : scan.ranges_m) {
      const bool is_near = static_cast<double>(range_m) < scan.range_min_m;  // something at the sensor itself
      free_m.push_back(is_near ? 0.0F : std::min(range_m, static_cast<float>(scan.range_max_m)));
    }
  }

  /// Did all rays towards the disc get as far as its centre, which lies at `to` from the sensor (map's axes)?
  bool sees(Point2 to, double radius_m) const {
    const double away2 = geometry::dot(to, to);
    if (away2 > far_m * far_m) return false;
    if (away2 <= radius_m * radius_m) return true;  // the sensor itself is there

    const double away_m = std::sqrt(away2);
    const double half_rad = radius_m / away_m;

    // In steps of the rays, from the first: the disc's centre lies at `at`, its rim at `at` +- `half`.
    double angle_rad = std::atan2(to.y, to.x) - first_rad;
    angle_rad -= kTurn_rad * std::floor(angle_rad / kTurn_rad);

    const double at = angle_rad / step_rad;
    const double half = half_rad / step_rad;

    // At least the two rays beside the centre.
    const int low = static_cast<int>(std::floor(std::min(at, std::ceil(at - half))));
    const int high = static_cast<int>(std::ceil(std::max(at, std::floor(at + half))));

    return get_as_far(low, high, static_cast<float>(away_m));
  }

  /// Are rays low..high all free up to `away_m`? Their numbers go on around a full turn.
  bool get_as_far(int low, int high, float away_m) const {
    const int rays = static_cast<int>(free_m.size());
    if (!goes_around && (low < 0 || high >= rays)) return false;

    for (int i = low; i <= high; ++i) {
      const int ray = i < 0 ? i + rays : i >= rays ? i - rays : i;
      if (ray < 0 || ray >= rays || free_m[static_cast<std::size_t>(ray)] < away_m) return false;
    }

    return true;
  }

  time::Stamp stamp;
  Point2 from_in_map;
  bool goes_around;
  double first_rad{0.0};
  double step_rad{0.0};
  double far_m;
  std::vector<float> free_m;  // of each ray
};

std::vector<std::pair<std::uint32_t, std::uint32_t>> Coverage::set_ground(const grid::Geometry& map) {
  std::vector<Place> told;
  if (map == map_) return told;

  for (const auto& [place, tile] : tiles_) {
    if (tile.told != kNever) told.push_back(place);
  }

  tiles_.clear();
  looked_.clear();
  map_ = map;
  width_cells_ = coarse_cells(map.width, map.resolution_m, params_.cell_m);
  height_cells_ = coarse_cells(map.height, map.resolution_m, params_.cell_m);

  return told;
}

void Coverage::take(const Scan& scan) {
  if (width_cells_ == 0 || height_cells_ == 0) return;

  const auto [last, is_first] = looked_.try_emplace(scan.agv_id, scan.stamp);
  if (!is_first && time::seconds(scan.stamp - last->second) < params_.look_every_s) return;

  last->second = scan.stamp;
  const Look look(scan);
  if (look.step_rad <= 0.0) return;  // turned against its scanner, faster than it

  // The tiles that the scanner's range touches.
  const double tile_m = kTileCells * params_.cell_m;
  const auto tile_of = [&](double from_low_m, int cells) {
    const double most = std::max(0, (cells - 1) / kTileCells);
    return static_cast<std::uint32_t>(std::clamp(std::floor(from_low_m / tile_m), 0.0, most));
  };

  const Point2 from_low = look.from_in_map - map_.origin_in_map;
  const std::uint32_t last_y = tile_of(from_low.y + look.far_m, height_cells_);
  const std::uint32_t last_x = tile_of(from_low.x + look.far_m, width_cells_);

  for (std::uint32_t y = tile_of(from_low.y - look.far_m, height_cells_); y <= last_y; ++y) {
    for (std::uint32_t x = tile_of(from_low.x - look.far_m, width_cells_); x <= last_x; ++x) look_over(look, {x, y});
  }
}

int Coverage::cells_of(std::uint32_t tile, int ground_cells) const {
  return std::min(kTileCells, ground_cells - static_cast<int>(tile) * kTileCells);
}

Coverage::Tile* Coverage::new_tile(Place place) {
  if (tiles_.size() >= kMostTiles) return nullptr;

  Tile tile;
  tile.seen.assign(static_cast<std::size_t>(cells_of(place.first, width_cells_)) *
                       static_cast<std::size_t>(cells_of(place.second, height_cells_)),
                   kNever);

  return &tiles_.emplace(place, std::move(tile)).first->second;
}

void Coverage::look_over(const Look& look, Place place) {
  const double cell_m = params_.cell_m;
  const int width = cells_of(place.first, width_cells_);
  const int height = cells_of(place.second, height_cells_);
  const Point2 low_in_map =
      map_.origin_in_map +
      kTileCells * cell_m * Point2{static_cast<double>(place.first), static_cast<double>(place.second)};
  const Point2 low = low_in_map - look.from_in_map;  // from the sensor

  // The cells within the scanner's range.
  const auto first = [&](double low_m, int cells) {
    return std::clamp(static_cast<int>(std::floor((-look.far_m - low_m) / cell_m)), 0, cells);
  };
  const auto last = [&](double low_m, int cells) {
    return std::clamp(static_cast<int>(std::ceil((look.far_m - low_m) / cell_m)), 0, cells);
  };

  const time::Stamp lately = look.stamp - time::from_seconds(0.5 * params_.look_every_s);
  const auto known = tiles_.find(place);
  Tile* tile = known == tiles_.end() ? nullptr : &known->second;

  // A tile is made when its first cell is seen.
  for (int y = first(low.y, height); y < last(low.y, height); ++y) {
    for (int x = first(low.x, width); x < last(low.x, width); ++x) {
      const std::size_t cell =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (tile != nullptr && tile->seen[cell] > lately) continue;  // by another vehicle: no need to look again

      if (!look.sees(low + cell_m * Point2{x + 0.5, y + 0.5}, 0.25 * cell_m)) continue;
      if (tile == nullptr) tile = new_tile(place);
      if (tile == nullptr) return;

      tile->seen[cell] = std::max(tile->seen[cell], look.stamp);
      tile->has_news = true;
    }
  }
}

std::vector<CoverageTile> Coverage::due(time::Stamp now) {
  std::vector<CoverageTile> due;
  for (auto& [place, tile] : tiles_) {
    if (!tile.has_news && time::seconds(now - tile.told) < params_.tell_again_s) continue;

    tile.has_news = false;
    tile.told = now;

    CoverageTile told;
    told.age_step_s = kAgeStep_s;
    told.tile_x = place.first;
    told.tile_y = place.second;

    told.cell_m = params_.cell_m;
    told.low_in_map =
        map_.origin_in_map +
        kTileCells * params_.cell_m * Point2{static_cast<double>(place.first), static_cast<double>(place.second)};
    told.width_cells = cells_of(place.first, width_cells_);
    told.height_cells = cells_of(place.second, height_cells_);

    told.ages.reserve(tile.seen.size());
    for (const time::Stamp seen : tile.seen) told.ages.push_back(age_code(seen, now));

    due.push_back(std::move(told));
  }

  return due;
}

}  // namespace aisle::obstacle_tracker
