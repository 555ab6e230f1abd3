#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "services/local-planner/core/lane.hpp"
#include "services/local-planner/core/room.hpp"
#include "services/local-planner/core/route.hpp"

namespace aisle::local_planner {

/// The way that is being driven: the plan's lane, with detours spliced into it, or for a while a way back, to try
/// again.
class Way {
 public:
  bool empty() const { return current().empty(); }

  /// A new lane; keeps a way back, if one is being driven. The lane begins near here, but for one that is made anew
  /// from the same plan: then about as much of it is left as before.
  void adopt(Lane lane, geometry::Point2 position_in_map, bool is_same_plan);

  /// A new lane on which the vehicle is near this place: its plan says so.
  void adopt_at(Lane lane, geometry::Point2 position_in_map, double about_plan_m);

  /// Leaves the lane at once for `points` and comes back to it further on, at `rejoin_m` of the current lane.
  void detour(const std::vector<geometry::Point2>& points, double rejoin_m);

  /// Drives `points` and stays there until `come_back`.
  void back_off(const std::vector<geometry::Point2>& points);

  /// Back to the lane, after the way back was driven, or because there is no more use for it.
  void come_back() { back_.reset(); }

  /// Is a way back being driven?
  bool backs_off() const { return back_.has_value(); }
  const Route& current() const { return back_ ? back_->route : lane_.route; }

  /// The lane, and how far the vehicle has come along it.
  const Route& lane() const { return lane_.route; }
  double lane_s_m() const { return lane_.s_m; }

  /// The lane's s where the plan has been driven so far; no detour may lie behind it.
  double lane_m(double plan_m) const { return lane_.route.length_m() - planned_.left_m(plan_m); }

  /// The same of the current way: the way back, while there is one.
  double s_m() const { return back_ ? back_->s_m : lane_.s_m; }
  double left_m() const { return current().length_m() - s_m(); }

  /// Is the vehicle still on the part of the lane that a detour took the place of?
  bool is_on_detour() const { return lane_.s_m < detour_end_m_; }

  /// Speeds in m/s at the current route's points, and between them.
  const std::vector<double>& profile_mps() const { return back_ ? back_->profile_mps : lane_.profile_mps; }
  double speed_at(double s_m) const;

  /// The s of the current route that is nearest to a point within the next half metre, and not beyond `most_m`: where
  /// the vehicle will be in a moment. Beyond a turn that it still drives to, the way may come back beside it.
  double s_near_m(geometry::Point2 p_in_map, double most_m = std::numeric_limits<double>::infinity()) const;

  /// Moves s on to where the vehicle is.
  void progress(geometry::Point2 position_in_map);

  /// The same near a place on the lane that is known, not beyond `most_m` of it, and not before `least_m`: the way may
  /// come back beside itself.
  void progress_at(geometry::Point2 position_in_map, double about_m, double most_m, double least_m = 0.0);

  /// Computes the speeds of new routes; does nothing when they are known.
  void profile(const grid::ClearanceField& clearance, double radius_m, const ProfileLimits& limits);

 private:
  /// A route, how far the vehicle has come along it, and the speeds at its points (empty: not computed yet).
  struct Part {
    Route route;
    double s_m{0.0};
    std::vector<double> profile_mps;
  };

  Lane planned_;  // without detours
  Part lane_;
  std::optional<Part> back_;
  double detour_end_m_{0.0};
};

/// A stretch of a route without room.
struct Obstructed {
  double begin_m{0.0};
  double end_m{0.0};  // from here on there is room again; beyond the route's end: there is none
  geometry::Point2 at_in_map;
};

/// The first stretch of the route from `s_m` on, beginning within `ahead_m`, that has less than `least_spare_m` to
/// spare; none: the route is free.
std::optional<Obstructed> first_obstructed(const Route& route, double s_m, double ahead_m, const Room& room,
                                           double least_spare_m);

}  // namespace aisle::local_planner
