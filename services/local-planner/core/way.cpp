#include "services/local-planner/core/way.hpp"

#include <algorithm>

namespace aisle::local_planner {

using geometry::Point2;

void Way::clear() {
  lane_ = {};
  aside_.reset();
  detour_end_m_ = 0.0;
}

void Way::adopt(Route lane, Point2 position_in_map, bool is_same_plan) {
  const double left_m = lane_.route.length_m() - lane_.s_m;
  lane_ = {std::move(lane), 0.0, {}};
  detour_end_m_ = 0.0;
  if (lane_.route.empty()) return;
  const double about_m = is_same_plan ? lane_.route.length_m() - left_m : 0.0;
  lane_.s_m = lane_.route.project(position_in_map, about_m - 5.0, about_m + 5.0);
  // A plan that was kept while we were not there to follow it, e.g. over a restart: we are somewhere along it.
  if (geometry::distance(lane_.route.at(lane_.s_m), position_in_map) > 1.5)
    lane_.s_m = lane_.route.project(position_in_map, 0.0, lane_.route.length_m());
}

void Way::detour(const std::vector<Point2>& points, double rejoin_m) {
  const double head_m = Route(points).length_m();
  lane_.route = lane_.route.spliced(resample(points, 0.2), rejoin_m);
  lane_.s_m = 0.0;
  lane_.profile_mps.clear();
  detour_end_m_ = head_m;
}

void Way::step_aside(const std::vector<Point2>& points) { aside_ = Part{Route(resample(points, 0.2)), 0.0, {}}; }

double Way::speed_at(double s_m) const {
  const auto& speeds = profile_mps();
  const Route& route = current();
  if (speeds.empty()) return 0.0;
  const std::size_t i = route.point_before(s_m);
  if (i + 1 >= speeds.size()) return speeds.back();
  const double share = std::clamp((s_m - route.along_m(i)) / (route.along_m(i + 1) - route.along_m(i)), 0.0, 1.0);
  return speeds[i] + share * (speeds[i + 1] - speeds[i]);
}

void Way::progress(Point2 position_in_map) {
  if (!lane_.route.empty() && !aside_)
    lane_.s_m = lane_.route.project(position_in_map, lane_.s_m - 0.3, lane_.s_m + 1.5);
  if (aside_ && !aside_->route.empty())
    aside_->s_m = aside_->route.project(position_in_map, aside_->s_m - 0.3, aside_->s_m + 1.5);
}

void Way::profile(const grid::ClearanceField& clearance, double radius_m, const ProfileLimits& limits) {
  if (lane_.profile_mps.size() != lane_.route.points().size())
    lane_.profile_mps = speed_profile(lane_.route, clearance, radius_m, limits);
  if (aside_ && aside_->profile_mps.size() != aside_->route.points().size())
    aside_->profile_mps = speed_profile(aside_->route, clearance, radius_m, limits);
}

std::optional<Obstructed> first_obstructed(const Route& route, double s_m, double ahead_m, const Room& room,
                                           double least_spare_m) {
  if (route.empty()) return std::nullopt;
  std::optional<Obstructed> found;
  double free_since = -1.0;
  for (double s = s_m; s <= route.length_m() + 0.2; s += 0.2) {
    const bool last = s >= route.length_m();
    const bool is_free = room.spare_m(route.at(s)) >= (found ? 0.0 : least_spare_m);
    if (!found && s > s_m + ahead_m) return std::nullopt;
    if (!found && !is_free) found = Obstructed{s, route.length_m() + 1.0, route.at(s)};
    if (!found) continue;
    if (!is_free) free_since = -1.0;
    if (is_free && free_since < 0.0) free_since = s;
    if (is_free && (s - free_since > 0.35 || last)) {
      found->end_m = std::min(s, route.length_m());
      return found;
    }
    if (s > found->begin_m + 10.0) return found;
  }
  return found;
}

}  // namespace aisle::local_planner
