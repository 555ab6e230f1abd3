#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/geometry/wide_vectors.hpp"
#include "services/local-planner/core/lanes.hpp"
#include "services/local-planner/core/twist_lanes.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Twist2;

constexpr double kStandingMps = 0.05;
constexpr double kStoodMps = 1e-3;
constexpr double kTinyM = 1e-6;

/// A bundle of samples that take up their speeds for one step and then brake along their arcs.
class Braking {
 public:
  Braking(const Scene& scene, const Needed& needed, const DwaSettings& settings, const Twist2* wanted,
          std::size_t count)
      : scene_(scene),
        needed_(needed),
        dt_(settings.step_s),
        braking_mps2_(settings.braking_share * scene.limits.max_deceleration_mps2),
        swing_(swing_m(scene)),
        count_(count),
        left_(count),
        lanes_(scene.base_in_map),
        outlines_(scene),
        walls_(outlines_, needed.wall_gaps_m, needed.wall),
        twists_(scene.twist) {
    is_done_.fill(false);
    take_up(TwistLanes(wanted, count));
    was_ = speed_;
    const bool stands = fastest(scene.twist) < kStoodMps;
    for (std::size_t i = 0; i < count_; ++i) {
      if (stands && speed_[i] < kStoodMps)
        finish(i, Obstruction::kNone);
      else if (needed_.somebody_touches && speed_[i] > 0.5 * kStandingMps)
        finish(i, Obstruction::kMover);
    }
  }

  void run(Obstruction* out) {
    if (stand_before_anything()) left_ = 0;
    for (double t = dt_; left_ > 0; t += dt_) {
      lanes_.step();
      outlines_.follow(lanes_);
      look(t);
      if (left_ > 0) brake();
    }
    std::copy_n(found_.begin(), count_, out);
  }

 private:
  /// Nobody is near, and the walls are farther than any of the samples drives until it stands: this step, and in whole
  /// steps while it brakes.
  AISLE_WIDE_VECTORS bool stand_before_anything() const {
    if (!needed_.peers.empty() || !needed_.movers.empty()) return false;
    double most_m = 0.0;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double tip_mps = std::abs(twists_.linear_mps[i]) + std::abs(twists_.sideways_mps[i]) +
                             swing_ * std::abs(twists_.angular_radps[i]);
      most_m = most(most_m, driven_m_[i] + tip_mps * (0.5 * speed_[i] / braking_mps2_ + dt_));
    }
    return most_m < *std::min_element(needed_.wall_gaps_m.begin(), needed_.wall_gaps_m.end()) - needed_.wall;
  }

  double fastest(const Twist2& twist) const {
    return std::max(speed_of(twist), swing_ * std::abs(twist.angular_radps));
  }

  void take_up(const TwistLanes& wanted) {
    if (scene_.limits.model == kinematics::Model::kDifferential) {
      follow_differential(twists_, wanted, scene_.limits, dt_);
    } else if (scene_.limits.model == kinematics::Model::kTricycle) {
      SteeringLanes(scene_.limits, scene_.steering_rad, wanted).follow_all(twists_, wanted, scene_.limits, dt_);
    } else {
      for (std::size_t i = 0; i < kLanes; ++i)
        twists_.set(i, kinematics::follow({scene_.twist, scene_.steering_rad}, wanted.at(i), scene_.limits, dt_).twist);
    }
    const TwistLanes now(scene_.twist);
    average(now.linear_mps, twists_.linear_mps, mean_.linear_mps);
    average(now.angular_radps, twists_.angular_radps, mean_.angular_radps);
    average(now.sideways_mps, twists_.sideways_mps, mean_.sideways_mps);
    find_speeds();
    set_steps();
  }

  AISLE_WIDE_VECTORS static void average(const Lane& before, const Lane& after, Lane& mean) {
    for (std::size_t i = 0; i < kLanes; ++i) mean[i] = 0.5 * (before[i] + after[i]);
  }

  /// Of the fastest point of each vehicle.
  AISLE_WIDE_VECTORS void find_speeds() {
    for (std::size_t i = 0; i < kLanes; ++i)
      speed_[i] = most(std::abs(twists_.linear_mps[i]), swing_ * std::abs(twists_.angular_radps[i]));
    for (std::size_t i = 0; scene_.limits.model == kinematics::Model::kOmnidirectional && i < kLanes; ++i)
      speed_[i] = fastest(twists_.at(i));
    standing_ = 0;
    for (std::size_t i = 0; i < kLanes; ++i) standing_ += speed_[i] < kStoodMps ? 1 : 0;
  }

  void set_steps() {
    lanes_.set_steps(mean_.linear_mps, mean_.angular_radps, mean_.sideways_mps, dt_);
    driven_m(mean_, swing_, dt_, driven_m_);
  }

  void finish(std::size_t i, Obstruction found) {
    if (is_done_[i]) return;
    is_done_[i] = true;
    found_[i] = found;
    walls_.leave(i);
    --left_;
  }

  /// Walls before peers before movers; who stands by now and has touched nothing is through.
  void look(double t_s) {
    if (walls_.look(outlines_, driven_m_))
      for (std::size_t i = 0; i < count_; ++i)
        if (walls_.least_gaps_m()[i] < needed_.wall - kTinyM) finish(i, Obstruction::kWall);
    if (!needed_.peers.empty() || !needed_.movers.empty()) {
      const Box box(lanes_);
      for (const auto& [peer, gap] : needed_.peers) look_at(*peer, gap, box);
      for (const auto& [mover, gap] : needed_.movers) look_at(*mover, gap, t_s, box);
    }
    if (standing_ == stood_) return;
    stood_ = standing_;
    for (std::size_t i = 0; i < count_; ++i)
      if (speed_[i] < kStoodMps) finish(i, Obstruction::kNone);
  }

  /// May a lane come nearer than `least_m` to the point?
  bool is_near(const Box& box, Point2 p, double least_m) const {
    const double reach_m = std::max(0.0, least_m) + swing_ + kTinyM;
    return box.distance2(p) < reach_m * reach_m;
  }

  void look_at(const PeerMotion& peer, double gap_m, const Box& box) {
    Lane squared, nearest;
    bool is_any = false;
    for (const Point2 q : peer.stopping_in_map) {
      if (!is_near(box, q, scene_.radius_m + peer.radius_m + gap_m)) continue;
      if (!is_any) nearest.fill(1e18);
      is_any = true;
      outlines_.distances2_to(q, squared);
      for (std::size_t i = 0; i < kLanes; ++i) nearest[i] = least(nearest[i], squared[i]);
    }
    for (std::size_t i = 0; is_any && i < count_; ++i)
      if (std::sqrt(nearest[i]) - scene_.radius_m - peer.radius_m < gap_m - kTinyM) finish(i, Obstruction::kPeer);
  }

  void look_at(const Mover& mover, double gap_m, double t_s, const Box& box) {
    const Point2 there = mover.position_in_map + t_s * mover.velocity_in_map;
    const double reach_m = mover.reach_m(t_s);
    if (!is_near(box, there,
                 scene_.radius_m + mover.radius_m + mover.margin_m + mover.growth_mps * t_s + reach_m + gap_m))
      return;
    Lane squared;
    outlines_.distances2_to(there, squared);
    for (std::size_t i = 0; i < count_; ++i) {
      const bool stood = was_[i] <= kStandingMps;  // throughout this step
      if (stood && mover.velocity_in_map != Point2{}) continue;
      const double reached_m = stood                      ? 0.0
                               : speed_[i] > kStandingMps ? reach_m
                                                          : mover.reach_m(t_s - stands_since_s(i));
      const double gap = std::sqrt(squared[i]) - scene_.radius_m - mover.radius_m - mover.margin_m -
                         mover.growth_mps * t_s - reached_m;
      if (gap < gap_m - kTinyM) finish(i, Obstruction::kMover);
    }
  }

  /// At the end of the step in which it came to stand.
  double stands_since_s(std::size_t i) const {
    return was_[i] > speed_[i] ? dt_ * (kStandingMps - speed_[i]) / (was_[i] - speed_[i]) : 0.0;
  }

  void brake() {
    was_ = speed_;
    slow_down();
    find_speeds();
    set_steps();
  }

  AISLE_WIDE_VECTORS void slow_down() {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double share = most(0.0, speed_[i] - braking_mps2_ * dt_) / most(speed_[i], kStoodMps);
      const double half = 0.5 * (1.0 + share);
      mean_.linear_mps[i] = half * twists_.linear_mps[i], mean_.angular_radps[i] = half * twists_.angular_radps[i];
      mean_.sideways_mps[i] = half * twists_.sideways_mps[i];
      twists_.linear_mps[i] *= share, twists_.angular_radps[i] *= share, twists_.sideways_mps[i] *= share;
    }
  }

  const Scene& scene_;
  const Needed& needed_;
  double dt_, braking_mps2_, swing_;
  std::size_t count_;
  std::size_t left_;
  Lanes lanes_;
  Outlines outlines_;
  WallWatch walls_;
  TwistLanes twists_, mean_;     // at the end of the step, and over it
  Lane speed_, was_, driven_m_;  // was_: speeds at the step's begin
  int standing_{0}, stood_{0};   // lanes that stand, and did so at the step before
  std::array<bool, kLanes> is_done_;
  std::array<Obstruction, kLanes> found_{};
};

}  // namespace

std::vector<Obstruction> obstructions(const Scene& scene, const Needed& needed, const std::vector<Twist2>& wanted,
                                      const DwaSettings& settings) {
  std::vector<Obstruction> found(wanted.size());
  for (std::size_t first = 0; first < wanted.size(); first += kLanes)
    Braking(scene, needed, settings, wanted.data() + first, std::min(kLanes, wanted.size() - first))
        .run(found.data() + first);
  return found;
}

Obstruction obstruction(const Scene& scene, const Twist2& wanted, const DwaSettings& settings) {
  return obstructions(scene, needed_gaps(scene, settings), {wanted}, settings).front();
}

}  // namespace aisle::local_planner
