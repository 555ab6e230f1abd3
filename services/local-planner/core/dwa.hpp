#pragma once

#include <array>
#include <numeric>
#include <vector>

#include "services/local-planner/core/critic.hpp"
#include "services/local-planner/core/rollout.hpp"

namespace aisle::local_planner {

/// The best sample, and what became of the others.
struct Choice {
  bool found{false};
  geometry::Twist2 twist;
  double wall_gap_m{0.0};
  double mover_gap_m{0.0};
  std::array<int, kObstructions> rejected{};
  int moving{0};  // samples that move and were not rejected

  int rejected_in_all() const { return std::accumulate(rejected.begin(), rejected.end(), 0); }

  /// How many were rejected for this reason.
  int rejected_by(Obstruction reason) const { return rejected[static_cast<std::size_t>(reason)]; }

  /// The samples that keep to the tube, if there is one; counts the others.
  std::vector<geometry::Twist2> without_leaving(const std::vector<geometry::Twist2>& wanted, const Scene& scene,
                                                const DwaSettings& settings);

  /// The samples that could stop; counts the others.
  std::vector<geometry::Twist2> without_obstructed(const std::vector<geometry::Twist2>& wanted,
                                                   const std::vector<Obstruction>& obstructions);

  /// May a sample be taken that collides with this? Standing may always be. Counts it.
  bool admit(bool moves, Obstruction collision);

  /// This sample is the best so far.
  void take(const Sample<double>& sample);
};

/// Another speed than the one in force must be worth a share of what a sample earns on the mean: else two speeds that
/// are almost as good send the vehicle up and down.
class Preference {
 public:
  Preference(const Scene& scene, const Variant& variant, const DwaSettings& settings);

  /// Less than any total.
  double least() const { return -mean_; }

  /// The total, less what a change of speed costs.
  double applied(double total, double linear_mps) const {
    return total - (linear_mps == speed_mps_ ? 0.0 : change_costs_);
  }

 private:
  double speed_mps_;  // in force
  double mean_{0.0};  // total: a critic's scores, divided by their mean, earn its weight on the mean
  double change_costs_{0.0};
};

/// Dynamic window approach (Fox, Burgard, Thrun 1997): samples the window of speeds, drops what could not stop or
/// collides within the horizon, and takes the best by the variant's critics.
///
/// How: `batched::choose`, or without the CMake option AISLE_VECTORS `plain::choose`, which says the same to the bit
/// and reads as the algorithm (plain_window.cpp).
Choice choose(const Scene& scene, const Aim& aim, const Variant& variant, const DwaSettings& settings);

namespace batched {
Choice choose(const Scene& scene, const Aim& aim, const Variant& variant, const DwaSettings& settings);
}

}  // namespace aisle::local_planner
