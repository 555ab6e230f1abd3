#include "services/local-planner/core/turns.hpp"

#include "common/geometry/bearings.hpp"
#include "common/geometry/wide_vectors.hpp"

namespace aisle::local_planner {

AISLE_WIDE_VECTORS void find_turns_rad(const Samples& samples, geometry::Point2 target_in_map, Lane& turns_rad) {
  using geometry::Wide;
  for (std::size_t first = 0; first < kLanes; first += geometry::kWide) {
    Wide x, y, yaw_rad, bearing_rad;
    geometry::load(&samples.look_x_m[first], x);
    geometry::load(&samples.look_y_m[first], y);
    geometry::load(&samples.look_yaw_rad[first], yaw_rad);
    geometry::find_bearing_rad(Wide(target_in_map.y - y), Wide(target_in_map.x - x), bearing_rad);
    const Wide difference_rad = bearing_rad - yaw_rad;
    const Wide apart_rad = difference_rad < 0.0 ? -difference_rad : difference_rad;
    const Wide other_way_rad = 2.0 * geometry::kPi - apart_rad;
    const Wide turn_rad = apart_rad < other_way_rad ? apart_rad : other_way_rad;
    geometry::store(turn_rad, &turns_rad[first]);
  }
}

}  // namespace aisle::local_planner
