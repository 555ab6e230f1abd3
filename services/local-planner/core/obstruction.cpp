#include <algorithm>
#include <array>
#include <cmath>

#include "services/local-planner/core/motion.hpp"
#include "services/local-planner/core/rollout.hpp"
#include "services/local-planner/core/walls.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Batch;
using geometry::least;
using geometry::magnitude;
using geometry::most;
using geometry::Point2;
using geometry::Twist2;

/// A block of samples: each takes up its twist for one step and then brakes along its arc, until it stands or touches
/// something. The first thing touched is what obstructs it.
///
/// Repaired: the papers' V_a (LI eq. 7, QU eq. 8, YU eq. 10, WANG eq. 9) is v <= sqrt(2 dist a), for a point and for
/// what stands. Followed along the arc it is the same limit for an outline and among things that move, and stronger: v
/// and w brake together. WANG prints the acceleration for a; the deceleration is meant.
class BrakingBlock {
 public:
  /// The first step is set, and samples are done of which nothing need be looked at.
  BrakingBlock(const Scene& scene, const Needed& needed, const DwaSettings& settings, const Twist2* wanted,
               std::size_t count)
      : scene_(scene),
        needed_(needed),
        dt_(settings.step_s),
        braking_mps2_(settings.braking_share * scene.limits.max_deceleration_mps2),
        swing_(swing_m(scene)),
        count_(count),
        left_(count),
        arcs_(scene.base_in_map),
        outlines_(scene, arcs_),
        walls_(outlines_, needed.wall_gaps_m, needed.wall),
        twists_(scene.twist) {
    take_up(TwistBlock(wanted, count));
    was_mps_ = speed_mps_;

    const bool stands = fastest_point_mps(scene.twist, swing_) < kStoodMps;
    for (std::size_t i = 0; i < count_; ++i) {
      if (stands && speed_mps_[i] < kStoodMps)
        finish(i, Obstruction::kNone);
      else if (needed_.is_person_beside && speed_mps_[i] > kBesidePersonMps)
        finish(i, Obstruction::kMover);
    }
  }

  /// Writes what obstructs each sample to `out`.
  void run(Obstruction* out) {
    if (stops_before_everything()) left_ = 0;

    for (double t_s = dt_; left_ > 0; t_s += dt_) {
      arcs_.step();
      look(t_s);
      if (left_ > 0) brake();
    }

    std::copy_n(found_.begin(), count_, out);
  }

 private:
  /// True only when the loop would find nothing: no mover or peer is near, and the walls are farther than any sample
  /// drives until it stands: in this step, and in whole steps while it brakes.
  AISLE_BATCHED bool stops_before_everything() const {
    if (!needed_.peers.empty() || !needed_.movers.empty()) return false;

    Batch most_m{};
    for (std::size_t b = 0; b < kBatches; ++b) {
      const Twist<Batch>& twist = twists_.batches[b];
      const Batch tip_mps =
          magnitude(twist.linear_mps) + magnitude(twist.sideways_mps) + swing_ * magnitude(twist.angular_radps);

      const Batch way_m = driven_m_.batch(b) + tip_mps * (0.5 * speed_mps_.batch(b) / braking_mps2_ + dt_);
      most_m = most(most_m, way_m);
    }

    const double free_m = *std::min_element(needed_.wall_gaps_m.begin(), needed_.wall_gaps_m.end()) - needed_.wall;
    return !geometry::any(most_m >= free_m);
  }

  /// The twists at the end of the first step, in which the command is taken up.
  void take_up(const TwistBlock& wanted) {
    if (scene_.limits.model == kinematics::Model::kDifferential) {
      follow_differential(twists_, wanted, scene_.limits, dt_);
    } else if (scene_.limits.model == kinematics::Model::kTricycle) {
      SteeringBlock(scene_.limits, scene_.steering_rad, wanted).follow_all(twists_, wanted, scene_.limits, dt_);
    } else {
      for (std::size_t i = 0; i < kBlock; ++i)
        twists_.set(i, kinematics::follow({scene_.twist, scene_.steering_rad}, wanted.at(i), scene_.limits, dt_).twist);
    }

    find_means();
    set_steps();
  }

  /// Over that step: the means of the twist in force and the one taken up.
  AISLE_BATCHED void find_means() {
    const Twist2& now = scene_.twist;
    for (std::size_t b = 0; b < kBatches; ++b) {
      const Twist<Batch>& twist = twists_.batches[b];
      mean_.batches[b] = {0.5 * (now.linear_mps + twist.linear_mps), 0.5 * (now.angular_radps + twist.angular_radps),
                          0.5 * (now.sideways_mps + twist.sideways_mps)};
    }
  }

  /// Speeds of the fastest points, and how many samples stand.
  AISLE_BATCHED void find_speeds() {
    geometry::BatchMask standing{};

    for (std::size_t b = 0; b < kBatches; ++b) {
      const Twist<Batch>& twist = twists_.batches[b];
      const Batch speed_mps = most<Batch>(magnitude(twist.linear_mps), swing_ * magnitude(twist.angular_radps));

      speed_mps_.put(b, speed_mps);
      standing += speed_mps < kStoodMps;
    }

    standing_ = geometry::count_of(standing);
    if (scene_.limits.model != kinematics::Model::kOmnidirectional) return;

    // Sideways speed counts as well: one by one.
    standing_ = 0;

    for (std::size_t i = 0; i < kBlock; ++i) {
      speed_mps_[i] = fastest_point_mps(twists_.at(i), swing_);
      standing_ += speed_mps_[i] < kStoodMps ? 1 : 0;
    }
  }

  /// The next step is driven with the means.
  void set_steps() {
    find_speeds();
    arcs_.set_steps(mean_, dt_);
    find_driven_m(mean_, swing_, dt_, driven_m_);
  }

  /// Sample i touches this, or stands without having touched anything; it is not looked at any more.
  void finish(std::size_t i, Obstruction found) {
    if (is_done_[i]) return;

    is_done_[i] = true;
    found_[i] = found;
    walls_.leave(i);
    --left_;
  }

  /// Walls before peers before movers; a sample that stands by now and has touched nothing is done.
  void look(double t_s) {
    if (walls_.look(driven_m_))
      for (std::size_t i = 0; i < count_; ++i)
        if (walls_.least_m()[i] < needed_.wall - kTinyM) finish(i, Obstruction::kWall);

    if (!needed_.peers.empty() || !needed_.movers.empty()) {
      const Box box = Box::around(arcs_);
      has_headings_ = false;
      for (const auto& [peer, gap_m] : needed_.peers) look_at(*peer, gap_m, box);
      for (const auto& [mover, gap_m] : needed_.movers) look_at(*mover, gap_m, t_s, box);
    }

    if (standing_ == stood_) return;

    stood_ = standing_;
    for (std::size_t i = 0; i < count_; ++i)
      if (speed_mps_[i] < kStoodMps) finish(i, Obstruction::kNone);
  }

  /// May a sample's outline come nearer than `least_m` to the point? Gets the headings ready where it may.
  bool is_near(const Box& box, Point2 p, double least_m) {
    const double reach_m = std::max(0.0, least_m) + swing_ + kTinyM;
    if (!(box.distance2(p) < reach_m * reach_m)) return false;
    if (!has_headings_) outlines_.find_headings();
    has_headings_ = true;

    return true;
  }

  /// The peer's whole sweep counts, as it may be anywhere on it while the sample brakes.
  void look_at(const PeerMotion& peer, double gap_m, const Box& box) {
    PerSample nearest2;
    bool is_first = true;

    for (const Point2 p : peer.stopping_in_map) {
      if (!is_near(box, p, scene_.radius_m + peer.radius_m + gap_m)) continue;
      find_nearest2(p, is_first, nearest2);
      is_first = false;
    }

    if (is_first) return;
    for (std::size_t i = 0; i < count_; ++i)
      if (std::sqrt(nearest2[i]) - scene_.radius_m - peer.radius_m < gap_m - kTinyM) finish(i, Obstruction::kPeer);
  }

  /// Squared metres to the nearest of the points so far; the first one overwrites.
  AISLE_BATCHED void find_nearest2(Point2 p, bool is_first, PerSample& nearest2) const {
    for (std::size_t b = 0; b < kBatches; ++b) {
      const Batch distance2 = outlines_.distance2(b, p);
      nearest2.put(b, is_first ? distance2 : least(nearest2.batch(b), distance2));
    }
  }

  /// A person who has changed the velocity since the motion was measured can be anywhere within reach by now. Only the
  /// time until the sample stands counts: touching a vehicle that stands is not its doing.
  void look_at(const Mover& mover, double gap_m, double t_s, const Box& box) {
    const Point2 there = mover.position_in_map + t_s * mover.velocity_in_map;
    const double reach_m = mover.reach_m(t_s);
    if (!is_near(box, there,
                 scene_.radius_m + mover.radius_m + mover.margin_m + mover.growth_mps * t_s + reach_m + gap_m))
      return;

    PerSample distance2;
    find_nearest2(there, true, distance2);

    for (std::size_t i = 0; i < count_; ++i) {
      const bool stood = was_mps_[i] <= kStandingMps;  // throughout this step
      if (stood && mover.velocity_in_map != Point2{}) continue;

      double reached_m = stood ? 0.0 : reach_m;
      if (!stood && speed_mps_[i] <= kStandingMps)
        reached_m = mover.reach_m(t_s - standing_since_s(was_mps_[i], speed_mps_[i], dt_));

      const double gap = std::sqrt(distance2[i]) - scene_.radius_m - mover.radius_m - mover.margin_m -
                         mover.growth_mps * t_s - reached_m;
      if (gap < gap_m - kTinyM) finish(i, Obstruction::kMover);
    }
  }

  /// One step of braking.
  void brake() {
    was_mps_ = speed_mps_;
    slow_down();
    set_steps();
  }

  /// Along its arc: all components shrink by the same share, v' = max(0, v - a dt). Driven is the mean of both.
  AISLE_BATCHED void slow_down() {
    for (std::size_t b = 0; b < kBatches; ++b) {
      Twist<Batch>&twist = twists_.batches[b], &mean = mean_.batches[b];

      const Batch speed_mps = speed_mps_.batch(b);
      const Batch share =
          most<Batch>(Batch{}, speed_mps - braking_mps2_ * dt_) / most<Batch>(speed_mps, Batch{} + kStoodMps);
      const Batch half = 0.5 * (1.0 + share);

      mean = {half * twist.linear_mps, half * twist.angular_radps, half * twist.sideways_mps};
      twist = {share * twist.linear_mps, share * twist.angular_radps, share * twist.sideways_mps};
    }
  }

  const Scene& scene_;
  const Needed& needed_;
  double dt_, braking_mps2_, swing_;
  std::size_t count_, left_;  // samples, and those not done
  ArcBlock arcs_;
  Outlines outlines_;
  WallGaps walls_;

  TwistBlock twists_, mean_;       // at the end of the step, and over it
  PerSample speed_mps_, was_mps_;  // of the fastest point at the end of the step, and at its begin
  PerSample driven_m_;             // in the step
  int standing_{0}, stood_{0};     // samples that stand, and that did at the step before
  bool has_headings_{false};       // of this step
  std::array<bool, kBlock> is_done_{};
  std::array<Obstruction, kBlock> found_{};
};

}  // namespace

std::vector<Obstruction> batched::obstructions(const Scene& scene, const Needed& needed,
                                               const std::vector<Twist2>& wanted, const DwaSettings& settings) {
  std::vector<Obstruction> found(wanted.size());
  for (std::size_t first = 0; first < wanted.size(); first += kBlock)
    BrakingBlock(scene, needed, settings, wanted.data() + first, std::min(kBlock, wanted.size() - first))
        .run(found.data() + first);

  return found;
}

}  // namespace aisle::local_planner
