#pragma once
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::local_planner {

/// One admissible (v, w) with what its trajectory meets, as critics see it.
struct Sample {
  geometry::Twist2 twist;
  geometry::Pose2 look_in_map;      // where it is after the heading time
  geometry::Point2 end_in_map;      // where it is at the horizon
  double wall_gap_m{0.0};           // least distance to walls, vehicle's radius taken off, at the cap at most
  double mover_gap_m{0.0};          // the same to predicted tracks and peers, margins taken off
  double standing_gap_m{0.0};       // to tracks that stand, radii taken off
  double moving_gap_m{0.0};         // to people and peers where they will be at that time, radii taken off
  double path_distance_m{0.0};      // mean distance of the trajectory to the way; 0 where the variant does not ask for it
};

/// What a cycle aims at.
struct Aim {
  geometry::Point2 target_in_map;   // temporary target: WANG's turning point, or the point of the way that is in sight
  double wall_cap_m{0.2};           // more room than this earns nothing; no more than the way itself has
  double mover_cap_m{0.6};
  geometry::Twist2 last;            // the command before
  geometry::Point2 sub_target_in_map{};           // the way's point nearest to the vehicle, a look-ahead further on
  std::vector<geometry::Point2> path_in_map{};    // the way from there to the horizon, every 0.2 m; empty: path distance is not asked for
  double radius_m{0.35};            // of the vehicle
  double step_s{0.1};               // of the trajectory
  double walls_s{1e9};              // walls are looked at for so long, at most to the horizon: beyond the target no arc is what will be driven
};

/// Scores are >= 0 and higher is better. They are divided by their sum over the admissible samples before weighting
/// (the papers' smoothing), so weights mean the same for every vehicle.
using Critic = double (*)(const Sample&, const Aim&);

double heading_critic(const Sample& sample, const Aim& aim);               // C1
double clearance_critic(const Sample& sample, const Aim& aim);             // C2
double velocity_critic(const Sample& sample, const Aim& aim);              // C3
double sub_target_heading_critic(const Sample& sample, const Aim& aim);    // C4
double path_distance_critic(const Sample& sample, const Aim& aim);         // C5
double sub_target_distance_critic(const Sample& sample, const Aim& aim);   // C6
double static_clearance_critic(const Sample& sample, const Aim& aim);      // C7
double dynamic_clearance_critic(const Sample& sample, const Aim& aim);     // C8

struct WeightedCritic {
  Critic score;
  double weight;
};

inline constexpr double from_degrees(double degrees) { return degrees * geometry::kPi / 180.0; }

/// The vehicle of a paper, for experiments beside its figures; a real vehicle has its own limits.
struct PaperLimits {
  double max_speed_mps{1.2};
  double max_turn_radps{1.2};
  double max_acceleration_mps2{0.8};
  double max_deceleration_mps2{1.2};
  double max_turn_acceleration_radps2{2.5};
  double horizon_s{2.0};
};

/// A local planner: critics and their weights. One file in core/variants/ a variant: `stem.cpp` defines `Variant stem()`.
struct Variant {
  std::string name;                 // as in configuration files
  std::vector<WeightedCritic> critics;
  bool knows_path{true};            // else it drives straight at the goal (the papers' traditional DWA)
  PaperLimits paper{};
  std::string summary{};            // one line
  bool has_rolling_window{false};   // WU: aims at a local sub-target while driving on along the path would end in a collision

  bool asks_for(Critic critic) const;
};

/// WANG: traditional DWA's critics towards the turning points of an optimised path.
Variant wang();

/// Every variant, by name.
const std::vector<Variant>& all_variants();

/// Null when there is none of this name.
const Variant* find_variant(const std::string& name);

/// Their names with commas, for messages.
std::string variant_names();

}  // namespace aisle::local_planner
