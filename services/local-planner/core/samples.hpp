#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "common/geometry/batch.hpp"
#include "common/geometry/pose.hpp"

namespace aisle::local_planner {

/// What stops a sample. The numbers only index `Choice::rejected`.
enum class Obstruction { kNone, kWall, kMover, kPeer, kTube };
inline constexpr std::size_t kObstructions = 5;

/// So many samples are rolled out and scored together: a block of eight batches.
inline constexpr std::size_t kBlock = 32;
inline constexpr std::size_t kBatches = kBlock / geometry::kBatch;

/// One number for each sample of a block.
class PerSample {
 public:
  double operator[](std::size_t i) const { return numbers_[i]; }
  double& operator[](std::size_t i) { return numbers_[i]; }
  void fill(double number) { numbers_.fill(number); }

  const double* begin() const { return numbers_.data(); }
  const double* end() const { return begin() + kBlock; }

  /// The numbers of batch `b`, and back.
  [[gnu::always_inline]] geometry::Batch batch(std::size_t b) const {
    geometry::Batch out;

    std::memcpy(&out, &numbers_[b * geometry::kBatch], sizeof(out));
    return out;
  }

  [[gnu::always_inline]] void put(std::size_t b, const geometry::Batch& batch) {
    std::memcpy(&numbers_[b * geometry::kBatch], &batch, sizeof(batch));
  }

 private:
  alignas(sizeof(geometry::Batch)) std::array<double, kBlock> numbers_;
};

/// A sample of the dynamic window: the twist, and what its trajectory meets. Number: double for one sample, Batch for
/// four. Of a sample that moves and collides with a wall only the twist is known.
template <class Number>
struct alignas(sizeof(Number)) Sample {
  Number linear_mps, angular_radps, sideways_mps;
  Number look_x_m, look_y_m, look_yaw_rad;  // pose in map after DwaSettings::heading_s; yaw within [-pi, pi]
  Number end_x_m, end_y_m;                  // position in map at the horizon
  Number wall_gap_m;                        // least distance from the outline to a wall, at most Aim::wall_cap_m
  Number mover_gap_m;      // to predicted tracks, radii and margins taken off, at most Aim::mover_cap_m
  Number standing_gap_m;   // to tracks that stand, radii taken off, at most the same
  Number moving_gap_m;     // to tracks that move, at the same time, radii taken off, at most the same
  Number path_distance_m;  // mean distance of the trajectory to Aim::path_in_map; 0 where that is empty
};

/// Up to 32 samples; a block with fewer is filled up with its last one.
struct SampleBlock {
  Sample<geometry::Batch> batches[kBatches];
  std::size_t count;                           // of samples, without those that fill up
  std::array<bool, kBlock> moves;              // some point of the vehicle is faster than 0.05 m/s
  std::array<Obstruction, kBlock> collisions;  // with what the trajectory collides within the horizon

  SampleBlock() {}  // leaves all unset: a cycle makes many blocks and writes every number

  /// Sample i by itself.
  Sample<double> at(std::size_t i) const {
    const Sample<geometry::Batch>& batch = batches[i / geometry::kBatch];
    const std::size_t k = i % geometry::kBatch;
    return {batch.linear_mps[k],     batch.angular_radps[k], batch.sideways_mps[k],   batch.look_x_m[k],
            batch.look_y_m[k],       batch.look_yaw_rad[k],  batch.end_x_m[k],        batch.end_y_m[k],
            batch.wall_gap_m[k],     batch.mover_gap_m[k],   batch.standing_gap_m[k], batch.moving_gap_m[k],
            batch.path_distance_m[k]};
  }
};

}  // namespace aisle::local_planner
