#pragma once

#include <vector>

#include "common/geometry/pose.hpp"
#include "services/local-planner/core/rollout.hpp"
#include "services/local-planner/core/route.hpp"
#include "services/local-planner/core/scene.hpp"

namespace aisle::local_planner {

/// The floor that is held for a vehicle among others: its outline stays within `half_width_m` of its outline on the
/// path.
struct Tube {
  std::vector<geometry::Point2> path_in_map;  // the way near the vehicle: at least one point
  double half_width_m{0.10};
};

/// The tube along a lane near the vehicle: from a bit behind `s_m` to a bit ahead of where it can brake, at most to
/// `end_m`.
Tube tube_along(const Route& lane, double s_m, double end_m, double half_width_m);

/// How far a vehicle's outline is off its outline on the path, in metres, at the path's point nearest to its base. Of
/// one that turns on the spot its heading counts for nothing; of others each disc of the footprint is compared with
/// where it would be with the path's heading, and the farthest counts. @pre the path has a point
double off_path_m(const std::vector<geometry::Point2>& path_in_map, const geometry::Pose2& base_in_map,
                  const std::vector<double>& discs_ahead_m, bool turns_on_the_spot);

/// Which twists keep to a tube. Made once a cycle.
class TubeKeeping {
 public:
  /// @param scene must outlive this object
  TubeKeeping(const Scene& scene, const Tube& tube, const DwaSettings& settings);

  /// Does a vehicle that takes up the twist for one step, and then brakes along its arc, stay in the tube until it
  /// stands? A bit is left to spare; one that is out of the tube already must come no farther out.
  ///
  /// How: looked at where the step ends, half-way through braking, and where the vehicle stands.
  bool to(const geometry::Twist2& wanted) const;

 private:
  double off_m(const geometry::Pose2& base_in_map) const;
  double most_off_m(double now_m) const;

  const Scene& scene_;
  double step_s_;
  double braking_mps2_;
  bool turns_on_the_spot_;
  std::vector<geometry::Point2> path_in_map_;
  double half_width_m_;
  double most_off_m_;
};

}  // namespace aisle::local_planner
