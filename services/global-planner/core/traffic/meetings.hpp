#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "services/global-planner/core/traffic/floor_bins.hpp"
#include "services/global-planner/core/traffic/roadmap.hpp"

namespace aisle::global_planner::traffic {

using ShapeId = std::uint32_t;

/// Shapes of places, motions and corners under dense numbers, and which of them meet. A pair is judged when it is first
/// asked for, and remembered: the conflicts of a whole roadmap are never enumerated.
class Meetings {
 public:
  /// @param gap_m shapes nearer to each other than this meet
  Meetings(const Roadmap& roadmap, double gap_m) : roadmap_(roadmap), gap_m_(gap_m) {}

  ShapeId of_place(PlaceId place);
  ShapeId of_motion(MotionId motion);

  /// The arc between two motions that follow each other; kNoId where the way is straight, or where the vehicle has arcs
  /// of its own.
  ShapeId of_corner(MotionId before, MotionId after);

  /// Floor that holds all corners at a place; kNoId where the vehicle has arcs of its own.
  ShapeId of_all_corners(PlaceId place);

  /// Valid until the next new shape.
  const Shape& shape(ShapeId id) const { return shapes_[id]; }
  const Box& box(ShapeId id) const { return shapes_[id].box(); }
  double gap_m() const { return gap_m_; }

  bool meet(ShapeId a, ShapeId b);

  /// Numbers of shapes are below this.
  std::size_t shapes() const { return shapes_.size(); }

  /// The ids have ended and may be given to other places and motions.
  void forget(const std::vector<PlaceId>& places, const std::vector<MotionId>& motions);

  /// How many shapes of places and motions that have ended still have their numbers.
  std::size_t ended() const { return ended_.size(); }

  /// Their numbers may be given to other shapes, but for those in use. @param is_used by number
  void reuse_ended(const std::vector<bool>& is_used);

 private:
  ShapeId add(const Shape& shape);
  void end(ShapeId& number);
  ShapeId numbered(std::vector<ShapeId>& numbers, std::uint32_t id, const Shape& shape);

  const Roadmap& roadmap_;
  double gap_m_;

  std::vector<Shape> shapes_;
  std::vector<ShapeId> free_;            // numbers that are not in use
  std::vector<ShapeId> ended_;           // numbers of shapes that nobody asks for any more
  std::vector<ShapeId> of_place_;        // by place; kNoId: not yet asked for
  std::vector<ShapeId> of_motion_;       // by motion
  std::vector<ShapeId> of_all_corners_;  // by place
  struct Corner {
    MotionId after{kNoId};
    ShapeId shape{kNoId};
  };
  std::vector<std::vector<Corner>> of_corner_;  // by the motion before
  std::unordered_map<std::uint64_t, bool> known_pairs_;
};

}  // namespace aisle::global_planner::traffic
