#pragma once

#include <vector>

#include "services/local-planner/core/dwa.hpp"

/// The dynamic window as plain loops over samples, without batches: the algorithm to read, and the reference that the
/// batched version is tested against, to the bit. It drives when the CMake option AISLE_VECTORS is off.
namespace aisle::local_planner::plain {

/// A sample that was rolled out.
struct Rollout {
  Sample<double> sample;
  bool moves{false};  // some point of the vehicle is faster than kStandingMps
  Obstruction collision{Obstruction::kNone};
};

/// What `local_planner::obstruction` says of each sample, in their order.
std::vector<Obstruction> obstructions(const Scene& scene, const Needed& needed,
                                      const std::vector<geometry::Twist2>& wanted, const DwaSettings& settings);

/// From the twist in force towards each of `wanted`, then on with it, to the horizon; in their order. Of a sample that
/// moves and collides with a wall only the twist and the collision are known.
std::vector<Rollout> roll_out(const Scene& scene, const Needed& needed, const std::vector<geometry::Twist2>& wanted,
                              const Aim& aim, const DwaSettings& settings);

/// Obstructions, rollouts, scores: the best sample.
Choice choose(const Scene& scene, const Aim& aim, const Variant& variant, const DwaSettings& settings);

}  // namespace aisle::local_planner::plain
