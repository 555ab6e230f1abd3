#pragma once
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::local_planner {

/// One admissible (v, w) with what its trajectory meets, as critics see it.
struct Sample {
  geometry::Twist2 twist;
  geometry::Pose2 look_in_map;      // where it is after the heading time
  geometry::Pose2 end_in_map;       // where it is at the horizon
  double wall_gap_m{0.0};           // least distance to walls, vehicle's radius taken off, at the cap at most
  double mover_gap_m{0.0};          // the same to predicted tracks and peers, margins taken off
};

/// What a cycle aims at.
struct Aim {
  geometry::Point2 target_in_map;   // temporary target: WANG's turning point, or the point of the way that is in sight
  double wall_cap_m{0.2};           // more room than this earns nothing
  double mover_cap_m{0.6};
  geometry::Twist2 last;            // the command before
};

/// Scores are >= 0 and higher is better. They are divided by their sum over the admissible samples before weighting
/// (the papers' smoothing), so weights mean the same for every vehicle.
using Critic = double (*)(const Sample&, const Aim&);

double heading_critic(const Sample& sample, const Aim& aim);       // C1
double clearance_critic(const Sample& sample, const Aim& aim);     // C2
double velocity_critic(const Sample& sample, const Aim& aim);      // C3

struct WeightedCritic {
  Critic score;
  double weight;
};

/// A local planner: critics and their weights.
struct Variant {
  const char* name;
  std::vector<WeightedCritic> critics;
};

/// WANG (000 seeds/004): traditional DWA's critics towards the turning points of an optimised path.
Variant wang();

}  // namespace aisle::local_planner
