#pragma once
#include <gtest/gtest.h>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// Every lane at the origin of the map, with no speed and no gap.
inline Samples blank_samples() {
  Samples samples;
  for (Lane* lane : {&samples.linear_mps, &samples.angular_radps, &samples.sideways_mps, &samples.look_x_m,
                     &samples.look_y_m, &samples.look_yaw_rad, &samples.end_x_m, &samples.end_y_m, &samples.wall_gap_m,
                     &samples.mover_gap_m, &samples.standing_gap_m, &samples.moving_gap_m, &samples.path_distance_m})
    lane->fill(0.0);
  samples.count = kLanes;
  samples.moves.fill(true);
  samples.collides.fill(Obstruction::kNone);
  return samples;
}

/// Of lanes that are all alike.
inline double score_of(Critic critic, const Samples& samples, const Aim& aim) {
  Lane scores;
  critic(samples, aim, scores);
  for (const double score : scores) EXPECT_EQ(score, scores.front());
  return scores.front();
}

}  // namespace aisle::local_planner
