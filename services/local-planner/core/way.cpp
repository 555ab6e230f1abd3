#include "services/local-planner/core/way.hpp"

#include <algorithm>
#include <utility>

namespace aisle::local_planner {

using geometry::Point2;

namespace {

constexpr double kBackM = 0.3;       // the vehicle is looked for so far back on its way,
constexpr double kAheadM = 1.5;      // and so far ahead
constexpr double kSoonAheadM = 0.5;  // where it will be in a moment
constexpr double kNearlyM = 0.2;     // a place that is known is known so exactly
constexpr double kAboutM = 5.0;      // around where it should be on a new lane
constexpr double kElsewhereM = 1.5;  // farther from there it may be anywhere on the lane
constexpr double kLookStepM = 0.2;   // between the points that may be obstructed
constexpr double kFreeForM = 0.35;   // an obstructed stretch ends where the way is free for so long
constexpr double kLongestM = 10.0;   // of an obstructed stretch, looked at
constexpr double kNoEndM = 1.0;      // beyond the route's end: no room was found

}  // namespace

void Way::adopt(Lane lane, Point2 position_in_map, bool is_same_plan) {
  const double left_m = lane_.route.length_m() - lane_.s_m;
  planned_ = std::move(lane);
  lane_ = {planned_.route, 0.0, {}};
  detour_end_m_ = 0.0;
  if (lane_.route.empty()) return;

  const double about_m = is_same_plan ? lane_.route.length_m() - left_m : 0.0;

  // Where it should be; if it is far from there, anywhere on the lane: the same plan may have been kept while the
  // vehicle was not there to follow it, as over a restart.
  lane_.s_m = lane_.route.project(position_in_map, about_m - kAboutM, about_m + kAboutM);
  if (geometry::distance(lane_.route.at(lane_.s_m), position_in_map) > kElsewhereM)
    lane_.s_m = lane_.route.project(position_in_map, 0.0, lane_.route.length_m());
}

void Way::adopt_at(Lane lane, Point2 position_in_map, double about_plan_m) {
  planned_ = std::move(lane);
  lane_ = {planned_.route, 0.0, {}};
  detour_end_m_ = 0.0;
  if (lane_.route.empty()) return;

  const double about_m = lane_m(about_plan_m);
  lane_.s_m = lane_.route.project(position_in_map, about_m - kSoonAheadM, about_m + kSoonAheadM);
}

void Way::detour(const std::vector<Point2>& points, double rejoin_m) {
  const double head_m = Route(points).length_m();
  lane_.route = lane_.route.spliced(resample(points, kRouteStepM), rejoin_m);
  lane_.s_m = 0.0;
  lane_.profile_mps.clear();
  detour_end_m_ = head_m;
}

void Way::back_off(const std::vector<Point2>& points) { back_ = Part{Route(resample(points, kRouteStepM)), 0.0, {}}; }

double Way::speed_at(double s_m) const {
  const auto& speeds = profile_mps();
  const Route& route = current();
  if (speeds.empty()) return 0.0;

  const std::size_t i = route.point_before(s_m);
  if (i + 1 >= speeds.size()) return speeds.back();
  const double share = std::clamp((s_m - route.along_m(i)) / (route.along_m(i + 1) - route.along_m(i)), 0.0, 1.0);

  return speeds[i] + share * (speeds[i + 1] - speeds[i]);
}

double Way::s_near_m(Point2 p_in_map, double most_m) const {
  return current().project(p_in_map, s_m(), std::max(s_m(), std::min(s_m() + kSoonAheadM, most_m)));
}

void Way::progress_at(Point2 position_in_map, double about_m, double most_m, double least_m) {
  const double ahead_m = std::min(about_m + kSoonAheadM, most_m);
  const double from_m = std::max(about_m - kNearlyM, least_m);
  lane_.s_m = lane_.route.project(position_in_map, std::min(from_m, ahead_m), ahead_m);
}

void Way::progress(Point2 position_in_map) {
  if (!lane_.route.empty() && !back_)
    lane_.s_m = lane_.route.project(position_in_map, lane_.s_m - kBackM, lane_.s_m + kAheadM);

  if (back_ && !back_->route.empty())
    back_->s_m = back_->route.project(position_in_map, back_->s_m - kBackM, back_->s_m + kAheadM);
}

void Way::profile(const grid::ClearanceField& clearance, double radius_m, const ProfileLimits& limits) {
  if (lane_.profile_mps.size() != lane_.route.points().size())
    lane_.profile_mps = speed_profile(lane_.route, clearance, radius_m, limits);

  if (back_ && back_->profile_mps.size() != back_->route.points().size())
    back_->profile_mps = speed_profile(back_->route, clearance, radius_m, limits);
}

std::optional<Obstructed> first_obstructed(const Route& route, double s_m, double ahead_m, const Room& room,
                                           double least_spare_m) {
  if (route.empty()) return std::nullopt;
  std::optional<Obstructed> found;

  std::optional<double> free_since_m;
  for (double s = s_m; s <= route.length_m() + kLookStepM; s += kLookStepM) {
    const bool last = s >= route.length_m();
    const bool is_free = room.spare_m(route.at(s)) >= (found ? 0.0 : least_spare_m);
    if (!found && s > s_m + ahead_m) return std::nullopt;
    if (!found && !is_free) found = Obstructed{s, route.length_m() + kNoEndM, route.at(s)};
    if (!found) continue;

    // Obstructed: it ends where the way has been free for long enough.
    if (!is_free) free_since_m.reset();
    if (is_free && !free_since_m) free_since_m = s;

    if (is_free && (s - *free_since_m > kFreeForM || last)) {
      found->end_m = std::min(s, route.length_m());
      return found;
    }

    if (s > found->begin_m + kLongestM) return found;
  }

  return found;
}

}  // namespace aisle::local_planner
