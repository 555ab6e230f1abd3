#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/global-planner/core/traffic/shape.hpp"

namespace aisle::global_planner::traffic {

/// Who holds which part of the floor. Shapes of two vehicles that were admitted never meet; nothing else is decided
/// here: no search, no clock.
///
/// A vehicle's shapes are numbered by its steps (the place where it stands is step 0 of its registration). A shape is
/// held from its admission until `release` with a step beyond it.
class Lock {
 public:
  /// @param gap_m shapes nearer to each other than this meet
  explicit Lock(double gap_m);

  /// Holds the shape for the vehicle if it meets no shape of another vehicle; else changes nothing and returns false.
  bool admit(const std::string& agv_id, std::uint64_t step, const Shape& shape);

  /// Vehicles whose shapes keep this one from being admitted, in the order of their ids.
  std::vector<std::string> holders(const std::string& agv_id, const Shape& shape) const;

  /// Holds the shape whatever it meets: the body of a vehicle that strays, has just joined, or does not obey. It takes
  /// the place of the vehicle's earlier forced shape; an empty one ends it.
  void force(const std::string& agv_id, const Shape& shape);

  /// The vehicle reports that it is behind all steps before `step`. Earlier numbers than before change nothing.
  void release(const std::string& agv_id, std::uint64_t step);

  /// Steps from `step` on were given back with the vehicle's word.
  void give_back(const std::string& agv_id, std::uint64_t step);

  /// The two stand too near to each other from the beginning: their shapes do not count against each other until they
  /// are apart. One may move, the other holds: that is the caller's to see to.
  void except(const std::string& a, const std::string& b);
  void end_exception(const std::string& a, const std::string& b);

  /// Everything that the vehicle holds ends: it was signed off.
  void forget(const std::string& agv_id);

  /// All shapes that the vehicle holds, by step; the forced one under step 0xffffffffffffffff.
  const std::map<std::uint64_t, Shape>& held(const std::string& agv_id) const;

 private:
  // (bins of 2 m over the floor; see lock.cpp)
};

}  // namespace aisle::global_planner::traffic
