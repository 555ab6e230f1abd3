#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/local-planner/core/lane.hpp"
#include "services/local-planner/core/room.hpp"
#include "services/local-planner/core/route.hpp"

namespace aisle::local_planner {

/// The way that is being driven: the plan's lane, with detours spliced into it, or for a while a way aside to let
/// others pass.
class Way {
 public:
  bool empty() const { return current().empty(); }
  /// Neither lane nor way aside.
  void clear();

  /// A new lane; keeps a way aside, if one is being driven. The lane begins near here, but for one that is made anew
  /// from the same plan: then about as much of it is left as before.
  void adopt(Route lane, geometry::Point2 position_in_map, bool is_same_plan);

  /// Leaves the lane at once for `points` and comes back to it further on, at `rejoin_m` of the current lane.
  void detour(const std::vector<geometry::Point2>& points, double rejoin_m);

  /// Drives `points` and stays there until `come_back`.
  void step_aside(const std::vector<geometry::Point2>& points);

  /// Back to the lane, after the way aside was driven, or because there is no more use for it.
  void come_back() { aside_.reset(); }
  void drop_aside() { aside_.reset(); }

  /// Is a way aside being driven?
  bool is_aside() const { return aside_.has_value(); }
  const Route& current() const { return aside_ ? aside_->route : lane_.route; }

  /// The lane, and how far the vehicle has come along it.
  const Route& lane() const { return lane_.route; }
  double lane_s_m() const { return lane_.s_m; }

  /// The same of the current way: the way aside, while there is one.
  double s_m() const { return aside_ ? aside_->s_m : lane_.s_m; }
  double left_m() const { return current().length_m() - s_m(); }

  /// Is the vehicle still on the part of the lane that a detour took the place of?
  bool is_on_detour() const { return lane_.s_m < detour_end_m_; }

  /// Speeds in m/s at the current route's points, and between them.
  const std::vector<double>& profile_mps() const { return aside_ ? aside_->profile_mps : lane_.profile_mps; }
  double speed_at(double s_m) const;

  /// The s of the current route that is nearest to a point within the next half metre: where the vehicle will be in a
  /// moment.
  double s_near_m(geometry::Point2 p_in_map) const;

  /// Moves s on to where the vehicle is.
  void progress(geometry::Point2 position_in_map);

  /// Computes the speeds of new routes; does nothing when they are known.
  void profile(const grid::ClearanceField& clearance, double radius_m, const ProfileLimits& limits);

 private:
  /// A route, how far the vehicle has come along it, and the speeds at its points (empty: not computed yet).
  struct Part {
    Route route;
    double s_m{0.0};
    std::vector<double> profile_mps;
  };

  Part lane_;
  std::optional<Part> aside_;
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
