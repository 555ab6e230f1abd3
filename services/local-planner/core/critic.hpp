#pragma once

#include <limits>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"
#include "services/local-planner/core/printed/as_printed.hpp"
#include "services/local-planner/core/samples.hpp"

namespace aisle::local_planner {

/// What a cycle aims at.
struct Aim {
  geometry::Point2 target_in_map;  // temporary target: WANG's turning point, or the point of the way that is in sight
  double wall_cap_m{0.2};          // more room than this earns nothing; no more than the way itself has
  double mover_cap_m{0.6};         // the same from tracks
  geometry::Point2 sub_target_in_map{};  // the way's point nearest to the vehicle, a look-ahead further on

  /// The way from there to the horizon, every 0.2 m; empty: path distance is not computed.
  std::vector<geometry::Point2> path_in_map{};

  double radius_m{0.35};  // of the vehicle
  double step_s{0.1};     // of the trajectory

  /// Walls count for so long, at most to the horizon: beyond the target no arc is what will be driven.
  double walls_s{std::numeric_limits<double>::infinity()};
};

/// Scores samples. Scores are >= 0 and higher is better. They are divided by their sum over the admissible samples
/// before weighting (the papers' smoothing), so weights mean the same for every vehicle.
///
/// A critic is one function template, `Number score(const Sample<Number>&, const Aim&)`, in a file of its own in
/// critics/: of a double it is the formula, of a Batch the same formula for four samples.
struct Critic {
  double (*score)(const Sample<double>& sample, const Aim& aim);
  void (*score_block)(const SampleBlock& samples, const Aim& aim, PerSample& scores);

  bool operator==(const Critic& other) const { return score == other.score; }
};

extern const Critic heading_critic;              // C1
extern const Critic clearance_critic;            // C2
extern const Critic velocity_critic;             // C3
extern const Critic sub_target_heading_critic;   // C4
extern const Critic path_distance_critic;        // C5
extern const Critic sub_target_distance_critic;  // C6
extern const Critic static_clearance_critic;     // C7
extern const Critic dynamic_clearance_critic;    // C8

/// A critic and its weight among the variant's.
struct WeightedCritic {
  Critic critic;
  double weight;
  std::string symbol{};  // of the weight in the paper: "alpha"
};

/// Radians.
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

  /// WU: aims at a local sub-target while driving on along the path would end in a collision.
  bool has_rolling_window{false};
  AsPrinted printed{};  // how it drives with Settings::as_printed, and not otherwise

  /// Does one of its critics look at this?
  bool asks_for(const Critic& critic) const;
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
