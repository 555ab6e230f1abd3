#pragma once
#include "services/local-planner/core/critic.hpp"
#include "services/local-planner/core/rollout.hpp"

namespace aisle::local_planner {

struct Choice {
  bool found{false};
  geometry::Twist2 twist;
  double wall_gap_m{0.0};
  double mover_gap_m{0.0};
  int rejected[4]{};  // by Obstruction
  int moving{0};      // samples that move and were not rejected
  int rejected_in_all() const { return rejected[0] + rejected[1] + rejected[2] + rejected[3]; }
};

/// Dynamic window approach (Fox, Burgard, Thrun 1997): samples the window of speeds, drops what could not stop or
/// collides within the horizon, and takes the best by the variant's critics.
Choice choose(const Scene& scene, const Aim& aim, const Variant& variant, const DwaSettings& settings);

}  // namespace aisle::local_planner
