#include "common/wire/world_obstacle.hpp"

#include "common/wire/geometry.hpp"

namespace aisle::wire {
namespace {

constexpr double kLargestM = 1000.0;

}  // namespace

aisle::WorldObstacle encode(const WorldObstacle& obstacle) {
  aisle::WorldObstacle sample;
  sample.obstacle_id(obstacle.id);
  sample.kind(static_cast<BodyKind>(obstacle.kind));
  sample.shape(static_cast<FootprintKind>(obstacle.footprint.shape));
  sample.base_in_map(encode(obstacle.base_in_map));
  sample.velocity_x_mps(obstacle.velocity_in_map.x);
  sample.velocity_y_mps(obstacle.velocity_in_map.y);
  sample.radius_m(obstacle.footprint.radius_m);
  sample.length_m(obstacle.footprint.length_m);
  sample.width_m(obstacle.footprint.width_m);
  sample.ahead_m(obstacle.footprint.ahead_m);
  return sample;
}

Decoded<WorldObstacle> decode(const aisle::WorldObstacle& sample) {
  Checks checks;
  WorldObstacle obstacle;
  obstacle.id = sample.obstacle_id().to_string();
  checks.id("obstacle_id", obstacle.id)
      .known("kind", sample.kind(), BodyKind::BODY_BLOCK)
      .known("shape", sample.shape(), FootprintKind::FOOTPRINT_RECTANGLE)
      .within("radius_m", sample.radius_m(), 0.0, kLargestM)
      .within("length_m", sample.length_m(), 0.0, kLargestM)
      .within("width_m", sample.width_m(), 0.0, kLargestM)
      .within("ahead_m", sample.ahead_m(), -kLargestM, kLargestM)
      .within("velocity_x_mps", sample.velocity_x_mps(), -kFastestMps, kFastestMps)
      .within("velocity_y_mps", sample.velocity_y_mps(), -kFastestMps, kFastestMps);
  obstacle.base_in_map = decode(sample.base_in_map(), checks, "base_in_map");
  if (!checks.ok()) return Decoded<WorldObstacle>::refused(checks.reason());
  obstacle.kind = static_cast<WorldObstacle::Kind>(sample.kind());
  obstacle.footprint = {static_cast<geometry::Body::Shape>(sample.shape()), sample.radius_m(), sample.length_m(),
                        sample.width_m(), sample.ahead_m()};
  obstacle.velocity_in_map = {sample.velocity_x_mps(), sample.velocity_y_mps()};
  obstacle.boot_id = sample.by().boot_id();
  return obstacle;
}

}  // namespace aisle::wire
