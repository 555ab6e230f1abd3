#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"
#include "services/local-planner/core/side_by_side.hpp"

namespace aisle::local_planner {

enum class Obstruction { kNone, kWall, kMover, kPeer };

/// Side by side as many (v, w) as there are lanes, with what their trajectories meet. Of one that moves and collides
/// with a wall no more than that is known. Not filled by itself; with fewer samples than lanes the last one stands in
/// the others too.
struct Samples {
  alignas(32) Lane linear_mps, angular_radps, sideways_mps;
  alignas(32) Lane look_x_m, look_y_m, look_yaw_rad;  // where it is in map after the heading time; yaw within [-pi, pi]
  alignas(32) Lane end_x_m, end_y_m;                  // where it is in map at the horizon
  alignas(32) Lane wall_gap_m;      // least distance to walls, vehicle's radius taken off, at the cap at most
  alignas(32) Lane mover_gap_m;     // the same to predicted tracks and peers, margins taken off
  alignas(32) Lane standing_gap_m;  // to tracks that stand, radii taken off
  alignas(32) Lane moving_gap_m;    // to people and peers where they will be at that time, radii taken off
  alignas(32) Lane
      path_distance_m;  // mean distance of the trajectory to the way; 0 where the variant does not ask for it
  std::size_t count;    // of samples
  std::array<bool, kLanes> moves;  // some point of the vehicle, faster than 0.05 m/s
  std::array<Obstruction, kLanes> collides;

  Samples() {}  // a cycle has many of them, and writes every one
  geometry::Twist2 twist(std::size_t i) const { return {linear_mps[i], angular_radps[i], sideways_mps[i]}; }
};

/// What a cycle aims at.
struct Aim {
  geometry::Point2 target_in_map;  // temporary target: WANG's turning point, or the point of the way that is in sight
  double wall_cap_m{0.2};          // more room than this earns nothing; no more than the way itself has
  double mover_cap_m{0.6};
  geometry::Twist2 last;                 // the command before
  geometry::Point2 sub_target_in_map{};  // the way's point nearest to the vehicle, a look-ahead further on
  std::vector<geometry::Point2>
      path_in_map{};      // the way from there to the horizon, every 0.2 m; empty: path distance is not asked for
  double radius_m{0.35};  // of the vehicle
  double step_s{0.1};     // of the trajectory
  double walls_s{
      1e9};  // walls are looked at for so long, at most to the horizon: beyond the target no arc is what will be driven
};

/// Writes a score for each lane. Scores are >= 0 and higher is better. They are divided by their sum over the
/// admissible samples before weighting (the papers' smoothing), so weights mean the same for every vehicle.
using Critic = void (*)(const Samples& samples, const Aim& aim, Lane& scores);

void heading_critic(const Samples& samples, const Aim& aim, Lane& scores);              // C1
void clearance_critic(const Samples& samples, const Aim& aim, Lane& scores);            // C2
void velocity_critic(const Samples& samples, const Aim& aim, Lane& scores);             // C3
void sub_target_heading_critic(const Samples& samples, const Aim& aim, Lane& scores);   // C4
void path_distance_critic(const Samples& samples, const Aim& aim, Lane& scores);        // C5
void sub_target_distance_critic(const Samples& samples, const Aim& aim, Lane& scores);  // C6
void static_clearance_critic(const Samples& samples, const Aim& aim, Lane& scores);     // C7
void dynamic_clearance_critic(const Samples& samples, const Aim& aim, Lane& scores);    // C8

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

/// A local planner: critics and their weights. One file in core/variants/ a variant: `stem.cpp` defines `Variant
/// stem()`.
struct Variant {
  std::string name;  // as in configuration files
  std::vector<WeightedCritic> critics;
  bool knows_path{true};  // else it drives straight at the goal (the papers' traditional DWA)
  PaperLimits paper{};
  std::string summary{};  // one line
  bool has_rolling_window{
      false};  // WU: aims at a local sub-target while driving on along the path would end in a collision

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
