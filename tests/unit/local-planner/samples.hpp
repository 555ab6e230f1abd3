#pragma once
#include <gtest/gtest.h>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// At the origin of the map, with no speed and no gap.
inline Sample<double> blank_sample() { return {}; }

/// A block of such samples.
inline SampleBlock block_of(const std::vector<Sample<double>>& samples) {
  SampleBlock block;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const Sample<double>& from = samples[std::min(i, samples.size() - 1)];
    Sample<geometry::Batch>& to = block.batches[i / geometry::kBatch];
    const std::size_t k = i % geometry::kBatch;
    to.linear_mps[k] = from.linear_mps, to.angular_radps[k] = from.angular_radps;
    to.sideways_mps[k] = from.sideways_mps;
    to.look_x_m[k] = from.look_x_m, to.look_y_m[k] = from.look_y_m, to.look_yaw_rad[k] = from.look_yaw_rad;
    to.end_x_m[k] = from.end_x_m, to.end_y_m[k] = from.end_y_m;
    to.wall_gap_m[k] = from.wall_gap_m, to.mover_gap_m[k] = from.mover_gap_m;
    to.standing_gap_m[k] = from.standing_gap_m, to.moving_gap_m[k] = from.moving_gap_m;
    to.path_distance_m[k] = from.path_distance_m;
  }
  block.count = kBlock;
  block.moves.fill(true);
  block.collisions.fill(Obstruction::kNone);
  return block;
}

/// What the critic gives one sample; a block of it gets the same.
inline double score_of(const Critic& critic, const Sample<double>& sample, const Aim& aim) {
  const double score = critic.score(sample, aim);
  PerSample scores;
  critic.score_block(block_of({sample}), aim, scores);
  for (const double of_block : scores) EXPECT_EQ(of_block, score);
  return score;
}

}  // namespace aisle::local_planner
