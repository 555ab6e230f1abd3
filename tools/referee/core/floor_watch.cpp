#include "tools/referee/core/floor_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "common/geometry/separation.hpp"
#include "tools/referee/core/contact_watch.hpp"

namespace aisle::referee {

using geometry::Body;
using geometry::Point2;
using geometry::Pose2;

void FloorWatch::shape_seen(const std::string& agv_id, const Shape& shape, double ahead_m) {
  Holder& holder = holders_[agv_id];
  holder.shape = shape;
  holder.ahead_m = ahead_m;
}

void FloorWatch::road_said(const std::string& agv_id, const std::vector<Pose2>& held_in_map, double t_s) {
  Holder& holder = holders_[agv_id];
  holder.floor = floor_along(holder, held_in_map);
  holder.said_s = t_s;

  for (const auto& [other, its] : holders_) {
    if (other != agv_id) judge(std::min(agv_id, other), std::max(agv_id, other), t_s);
  }
}

/// Where it stands at each pose, and between two poses the rectangle that its outline sweeps with the heading of that
/// leg.
std::vector<Body> FloorWatch::floor_along(const Holder& holder, const std::vector<Pose2>& held_in_map) {
  const bool is_disc = holder.shape.is_disc();
  const double length_m = is_disc ? 0.0 : holder.shape.length_m + 2.0 * holder.shape.radius_m;
  const double width_m = holder.shape.width_m + 2.0 * holder.shape.radius_m;
  const auto swept = [&](Point2 base, double yaw_rad, double leg_m) {
    const Pose2 middle = middle_in_map({base.x, base.y, yaw_rad}, holder.ahead_m);
    return Body{Body::Shape::kRectangle, middle, 0.0, leg_m + length_m, width_m};
  };
  const auto standing = [&](const Pose2& base) {
    return is_disc ? Body{Body::Shape::kDisc, base, holder.shape.radius_m, 0.0, 0.0}
                   : swept(base.position(), base.yaw, 0.0);
  };

  std::vector<Body> floor;
  if (!held_in_map.empty()) floor.push_back(standing(held_in_map.front()));

  for (std::size_t i = 1; i < held_in_map.size(); ++i) {
    const Point2 from = held_in_map[i - 1].position(), to = held_in_map[i].position();
    const double leg_m = geometry::distance(from, to);
    if (leg_m > 0.0) floor.push_back(swept(0.5 * (from + to), geometry::bearing(from, to), leg_m));
    if (is_disc) floor.push_back(standing(held_in_map[i]));
  }

  return floor;
}

const Body* FloorWatch::shared(const Holder& a, const Holder& b) {
  for (const Body& mine : a.floor) {
    for (const Body& its : b.floor) {
      const double apart_m = geometry::distance(mine.base_in_map.position(), its.base_in_map.position());
      if (apart_m < geometry::reach_m(mine) + geometry::reach_m(its) && geometry::separation_m(mine, its) < -kClearly_m)
        return &mine;
    }
  }

  return nullptr;
}

void FloorWatch::judge(const std::string& a, const std::string& b, double t_s) {
  const Holder &one = holders_[a], &other = holders_[b];
  const Body* where = shared(one, other);
  if (where == nullptr) {
    overlaps_.erase({a, b});
    return;
  }

  Overlap& overlap = overlaps_.try_emplace({a, b}, Overlap{t_s, false}).first->second;
  const bool is_confirmed = std::min(one.said_s, other.said_s) >= overlap.since_s + kLater_s;
  if (overlap.is_told || !is_confirmed) return;

  overlap.is_told = true;
  violations_.push_back(
      {AuthorityViolation::Kind::kFloorHeldTwice, a, overlap.since_s,
       fmt::format("holds floor at ({:.2f}, {:.2f}) that {} holds", where->base_in_map.x, where->base_in_map.y, b)});
}

}  // namespace aisle::referee
