#pragma once

#include <vector>

#include "common/geometry/footprint.hpp"
#include "common/geometry/pose.hpp"
#include "common/kinematics/limits.hpp"
#include "services/global-planner/core/traffic/floor_bins.hpp"

namespace aisle::global_planner::traffic {

/// All points of the floor within `radius_m` of a straight segment, in map.
struct Capsule {
  geometry::Point2 from_in_map;
  geometry::Point2 to_in_map;
  double radius_m{0.0};
};

/// A part of the floor: a union of capsules, with the box around it.
class Shape {
 public:
  Shape() = default;
  explicit Shape(std::vector<Capsule> capsules);

  const std::vector<Capsule>& capsules() const { return capsules_; }
  bool empty() const { return capsules_.empty(); }

  /// The axis-aligned box around all capsules, and its corners. @pre not empty
  const Box& box() const { return box_; }
  geometry::Point2 low_in_map() const { return box_.low_in_map; }
  geometry::Point2 high_in_map() const { return box_.high_in_map; }

  void add(const Shape& other);

  /// The shape moved by an offset in map.
  Shape moved(geometry::Point2 by) const;

 private:
  std::vector<Capsule> capsules_;
  Box box_;
};

/// Metres between two shapes; 0 where they overlap, infinity where one of them is empty.
double gap_between_m(const Shape& a, const Shape& b);

/// The same, but negative where they overlap: minus what the radii of some two capsules reach into each other.
double separation_m(const Shape& a, const Shape& b);

/// Are the shapes nearer to each other than `gap_m`? Shapes whose gap equals it to within 1 nm do not meet.
bool meet(const Shape& a, const Shape& b, double gap_m);

/// Does all of `inner` lie within `outer`, to within 1 nm?
bool is_inside(const Capsule& inner, const Capsule& outer);

/// What the traffic must know of a vehicle's build. Vehicles with equal kinds share a roadmap.
struct Kind {
  geometry::Footprint footprint;
  kinematics::Limits limits;
  double tube_m{0.10};           // the outline stays within this of its outline on the path
  double wall_margin_m{0.10};    // kept free of walls beside the outline
  double turning_radius_m{0.0};  // of the tightest arc that plans have; 0: it turns on the spot

  bool turns_on_the_spot() const { return turning_radius_m <= 0.0; }
};

bool operator==(const Kind& a, const Kind& b);

/// The floor of a vehicle that stands with its frame there, its tube included. One that turns on the spot may turn to
/// any heading: a disc of its circumscribed radius.
Shape standing_shape(const Kind& kind, const geometry::Pose2& base_in_map);

/// The floor that the vehicle sweeps, tube included, when its frame drives the polyline. Corners within the path are
/// rounded by arcs that begin `kCornerM` (or half the shorter leg) before the corner: the chord of each arc is swept as
/// well. A vehicle that turns on the spot may turn anywhere on it. Where `headings_rad` is not empty, it holds the
/// heading at each point (vehicles that do not turn on the spot). The floor of the vehicle that stands at the path's
/// end is inside: each capsule of it lies in one of the sweep's.
Shape swept_shape(const Kind& kind, const std::vector<geometry::Point2>& path_in_map,
                  const std::vector<double>& headings_rad = {});

/// The floor of the arc that cuts the corner between two steps, tube included; empty when the way is straight there.
Shape corner_shape(const Kind& kind, geometry::Point2 before_in_map, geometry::Point2 corner_in_map,
                   geometry::Point2 after_in_map);

/// A disc that holds the `corner_shape` of every corner there; empty where the vehicle has arcs of its own.
Shape all_corners_shape(const Kind& kind, geometry::Point2 corner_in_map);

inline constexpr double kCornerM = 0.5;  // an arc begins so far before a corner, and ends so far behind it

}  // namespace aisle::global_planner::traffic
