#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/geometry/batch.hpp"
#include "common/geometry/pose.hpp"
#include "common/kinematics/limits.hpp"
#include "services/local-planner/core/samples.hpp"

namespace aisle::local_planner {

/// Length of the velocity of the base, m/s.
double speed_of(const geometry::Twist2& twist);

/// Equal to the bit.
inline bool is_same(const geometry::Twist2& a, const geometry::Twist2& b) {
  return a.linear_mps == b.linear_mps && a.angular_radps == b.angular_radps && a.sideways_mps == b.sideways_mps;
}

/// A twist in the vehicle's own frame. Number: double for one sample, Batch for four.
template <class Number>
struct alignas(sizeof(Number)) Twist {
  Number linear_mps, angular_radps, sideways_mps;
};

/// The twists of a block of samples.
struct TwistBlock {
  Twist<geometry::Batch> batches[kBatches];

  TwistBlock() {}  // leaves all unset
  explicit TwistBlock(const geometry::Twist2& all);

  /// Filled up with the last one. @pre 0 < count <= kBlock
  TwistBlock(const geometry::Twist2* twists, std::size_t count);

  /// The twist of sample i.
  geometry::Twist2 at(std::size_t i) const {
    const Twist<geometry::Batch>& batch = batches[i / geometry::kBatch];
    const std::size_t k = i % geometry::kBatch;
    return {batch.linear_mps[k], batch.angular_radps[k], batch.sideways_mps[k]};
  }

  /// Sets the twist of sample i.
  void set(std::size_t i, const geometry::Twist2& twist) {
    Twist<geometry::Batch>& batch = batches[i / geometry::kBatch];
    const std::size_t k = i % geometry::kBatch;
    batch.linear_mps[k] = twist.linear_mps;
    batch.angular_radps[k] = twist.angular_radps;
    batch.sideways_mps[k] = twist.sideways_mps;
  }
};

/// Is any sample's twist another in `b` than in `a`?
bool differ(const TwistBlock& a, const TwistBlock& b);

/// Does any sample move sideways?
bool goes_sideways(const TwistBlock& twists);

/// A pose that steps along arcs, its heading kept as a unit vector: a step calls no trigonometric function. Number:
/// double for one sample, Batch for four.
///
/// How: driving v dt while turning by w dt ends at the end of the arc's chord, which points half the turn (h = w dt /
/// 2) from the heading and is v dt sin(h) / h long. What is kept is the chord's direction; a step turns it by the whole
/// turn, which is two multiplications of unit vectors. Series in h replace sine and cosine up to kSeriesRad.
template <class Number>
class alignas(sizeof(Number)) Arc {
 public:
  Number x, y;  // in map

  /// Stands at the pose; the unit vectors of no turn.
  [[gnu::always_inline]] void begin(const geometry::Pose2& base_in_map) {
    x = Number{} + base_in_map.x;
    y = Number{} + base_in_map.y;
    cos_chord_ = Number{} + std::cos(base_in_map.yaw);
    sin_chord_ = Number{} + std::sin(base_in_map.yaw);
    cos_half_ = cos_turn_ = Number{} + 1.0;
    sin_half_ = sin_turn_ = ahead_m_ = left_m_ = Number{};
  }

  /// The twist of the steps from now on.
  [[gnu::always_inline]] void set_step(const Twist<Number>& twist, double dt_s) {
    const Number half = 0.5 * twist.angular_radps * dt_s;

    const Number h2 = half * half;

    // cos h and sin h, and the length of the chord, sin(h) / h = 1 - h^2/6 + ...
    Number c = 1.0 - 0.5 * h2 + h2 * h2 / 24.0;
    Number s = half * (1.0 - h2 / 6.0 + h2 * h2 / 120.0);
    ahead_m_ = twist.linear_mps * dt_s * (1.0 - h2 / 6.0);
    left_m_ = twist.sideways_mps * dt_s * (1.0 - h2 / 6.0);

    const auto is_far = geometry::magnitude(half) >= kSeriesRad;
    if (geometry::any(is_far)) find_exactly(half, is_far, c, s);

    const Number cos_now = cos_yaw();
    const Number sin_now = sin_yaw();
    cos_chord_ = c * cos_now - s * sin_now;
    sin_chord_ = s * cos_now + c * sin_now;
    cos_half_ = c;
    sin_half_ = s;
    cos_turn_ = c * c - s * s;
    sin_turn_ = 2.0 * s * c;
  }

  /// One step along the arc: to the end of its chord, which the whole turn then turns.
  /// @param sideways false: no sample has a sideways speed, which then need not be looked at
  [[gnu::always_inline]] void step(bool sideways) {
    const Number c = cos_chord_;
    const Number s = sin_chord_;

    x = x + ahead_m_ * c;
    y = y + ahead_m_ * s;
    if (sideways) {
      x = x - left_m_ * s;
      y = y + left_m_ * c;
    }

    cos_chord_ = cos_turn_ * c - sin_turn_ * s;
    sin_chord_ = sin_turn_ * c + cos_turn_ * s;
  }

  [[gnu::always_inline]] Number cos_yaw() const { return cos_half_ * cos_chord_ + sin_half_ * sin_chord_; }
  [[gnu::always_inline]] Number sin_yaw() const { return cos_half_ * sin_chord_ - sin_half_ * cos_chord_; }

 private:
  static constexpr double kSeriesRad = 0.15;  // up to here the series are right to 1e-11

  static void find_exactly(double half, bool, double& c, double& s) { c = std::cos(half), s = std::sin(half); }
  static void find_exactly(const geometry::Batch& half, const geometry::BatchMask& is_far, geometry::Batch& c,
                           geometry::Batch& s) {
    for (std::size_t i = 0; i < geometry::kBatch; ++i)
      if (is_far[i] != 0) {
        c[i] = std::cos(half[i]);
        s[i] = std::sin(half[i]);
      }
  }

  Number cos_chord_, sin_chord_;  // direction of the next step's chord: the heading, and half the step's turn
  Number cos_half_, sin_half_;    // of half a step's turn
  Number cos_turn_, sin_turn_;    // of all of it
  Number ahead_m_, left_m_;       // the chord, in the frame that points along its direction
};

/// The poses of a block of samples.
struct ArcBlock {
  Arc<geometry::Batch> batches[kBatches];
  bool sideways{false};

  /// All at `base_in_map`; until a twist is set they stand.
  explicit ArcBlock(const geometry::Pose2& base_in_map);

  /// The twists of the steps from now on.
  void set_steps(const TwistBlock& twists, double dt_s);

  /// One step of all samples.
  void step();

  /// Base of sample i, in map.
  geometry::Point2 position(std::size_t i) const {
    const Arc<geometry::Batch>& arc = batches[i / geometry::kBatch];
    return {arc.x[i % geometry::kBatch], arc.y[i % geometry::kBatch]};
  }
};

/// `kinematics::follow` of a differential drive for each sample, to the bit. @pre `limits.model` is kDifferential
void follow_differential(TwistBlock& twists, const TwistBlock& wanted, const kinematics::Limits& limits, double dt_s);

/// The steered wheels of a block of tricycles: `kinematics::follow` of a tricycle for each sample, to the bit.
class SteeringBlock {
 public:
  /// Nothing to do for other models.
  SteeringBlock(const kinematics::Limits& limits, double steering_rad, const TwistBlock& wanted);

  /// @pre `limits.model` is kTricycle, `wanted` is what it was made with
  void follow_all(TwistBlock& twists, const TwistBlock& wanted, const kinematics::Limits& limits, double dt_s);

  /// The same, but samples whose twist is the wanted one already keep their twist and steering angle.
  void follow(TwistBlock& twists, const TwistBlock& wanted, const kinematics::Limits& limits, double dt_s);

  /// Did a wheel turn in the last step?
  bool is_turning() const { return is_turning_; }

 private:
  /// Turns each wheel towards its target, by at most so much.
  void turn(double most_rad);

  /// The twists by the wheels' angles, v tan(angle) / wheelbase.
  void drive(TwistBlock& twists, const TwistBlock& wanted, const kinematics::Limits& limits, double dt_s) const;

  PerSample target_rad_;    // angle of the wheel that the wanted arc asks for
  PerSample steering_rad_;  // its angle now,
  PerSample tangent_;       // and the tangent of that
  bool is_turning_{false};
};

/// An upper bound of the way that any point of each vehicle drives in a step: the base's way and `swing_m` (farthest
/// disc centre from the base) of its turn; in metres.
void find_driven_m(const TwistBlock& twists, double swing_m, double dt_s, PerSample& driven_m);

}  // namespace aisle::local_planner
