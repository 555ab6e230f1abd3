#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "services/local-planner/core/critic.hpp"
#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/settings.hpp"
#include "services/local-planner/core/surroundings.hpp"
#include "services/local-planner/core/tube.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// A way that is driven, and how fast.
struct OnWay {
  const Moment& moment;
  const Way& way;
  const Surroundings& around;
  geometry::Twist2 in_force;  // the twist before this cycle's command

  const Tube* tube{nullptr};                               // that it keeps to; none: all the free floor
  double most_m{std::numeric_limits<double>::infinity()};  // of the way: nothing beyond is driven at yet
};

/// What is driven at, as the vehicle will see it when the command acts.
struct Target {
  geometry::Point2 in_map;
  double error_rad{0.0};  // from the heading to it, to the left
  double distance_m{0.0};
};

/// A point in map as the target of this cycle.
Target target_at(geometry::Point2 in_map, const OwnMotion& motion);

/// The way's farthest point that is in sight, 0.7 to 1.8 m ahead, the farther the faster: straight on to there there is
/// room, and the tube, if there is one, is not left. Of a planner that knows no path: the way's end. In map.
geometry::Point2 target_in_sight(const OnWay& on_way, bool knows_path);

/// WU's rolling window: the sub-target beside the way, where driving on at `target_in_map` would end in a collision.
/// None: keep to the way; also in a tube, while it backs off, and for a vehicle that cannot turn back to its way on the
/// spot.
std::optional<geometry::Point2> sub_target_beside(const OnWay& on_way, const Scene& scene,
                                                  geometry::Point2 target_in_map);

/// The route from `s_m` on for `ahead_m`, as points every 0.2 m: what path distance is measured to.
std::vector<geometry::Point2> points_ahead(const Route& route, double s_m, double ahead_m);

/// The target as the dynamic window's critics look at it: with LI's sub-target on the way, the way ahead where they ask
/// for it, and as much room at the walls as the way itself has.
Aim aim_at(geometry::Point2 target_in_map, const OnWay& on_way, const Variant& variant, const DwaSettings& settings);

}  // namespace aisle::local_planner
