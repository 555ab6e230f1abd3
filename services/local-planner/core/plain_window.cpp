#include "services/local-planner/core/plain_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "common/geometry/bearings.hpp"
#include "services/local-planner/core/motion.hpp"
#include "services/local-planner/core/plain_walls.hpp"
#include "services/local-planner/core/speed_window.hpp"
#include "services/local-planner/core/walls.hpp"

namespace aisle::local_planner::plain {
namespace {

using geometry::Point2;
using geometry::Twist2;

/// The vehicles of a block of samples: they step together, since a step is set anew for all of them or for none, and
/// since walls are looked up for four of them at a time. Both show in the last bit only.
class Vehicles {
 public:
  /// Filled up with the last of `wanted` to kBlock.
  Vehicles(const Scene& scene, const Twist2* wanted, std::size_t count, double dt_s)
      : scene_(scene), dt_(dt_s), swing_(swing_m(scene)), arcs_(kBlock), driven_m_(kBlock, 0.0) {
    for (std::size_t i = 0; i < kBlock; ++i) wanted_.push_back(wanted[std::min(i, count - 1)]);
    states_.assign(kBlock, {scene.twist, scene.steering_rad});
    for (Arc<double>& arc : arcs_) arc.begin(scene.base_in_map);
  }

  /// Metres from the base to the farthest disc centre.
  double swing() const { return swing_; }

  const Twist2& wanted(std::size_t i) const { return wanted_[i]; }
  const Twist2& twist(std::size_t i) const { return states_[i].twist; }
  const std::vector<Arc<double>>& arcs() const { return arcs_; }
  const std::vector<double>& driven_m() const { return driven_m_; }

  /// Each takes up its wanted twist, as far as it can within a step. False: nothing changed.
  bool follow(bool keep_reached) {
    const auto is_there = [&](std::size_t i) { return keep_reached && is_same(states_[i].twist, wanted_[i]); };
    const bool is_tricycle = scene_.limits.model == kinematics::Model::kTricycle;
    bool changes = false;
    bool all_are_there = true;

    for (std::size_t i = 0; i < kBlock; ++i) all_are_there = all_are_there && is_there(i);
    if (!all_are_there) is_steering_ = false;

    for (std::size_t i = 0; i < kBlock && !all_are_there; ++i) {
      const kinematics::DriveState next = kinematics::follow(states_[i], wanted_[i], scene_.limits, dt_);
      is_steering_ = is_steering_ || (is_tricycle && next.steering_rad != states_[i].steering_rad);
      if (is_there(i) && scene_.limits.model != kinematics::Model::kDifferential) continue;
      changes = changes || !is_same(next.twist, states_[i].twist);
      states_[i] = next;
    }

    return changes || is_steering_;
  }

  /// Vehicle i has this twist now.
  void set(std::size_t i, const Twist2& twist) { states_[i].twist = twist; }

  /// The next steps are driven with these twists.
  template <class TwistOf>
  void set_steps(const TwistOf& twist_of) {
    sideways_ = false;
    for (std::size_t i = 0; i < kBlock; ++i) sideways_ = sideways_ || twist_of(i).sideways_mps != 0.0;

    for (std::size_t i = 0; i < kBlock; ++i) {
      const Twist2 twist = twist_of(i);
      const double across_mps = swing_ * twist.angular_radps;
      arcs_[i].set_step({twist.linear_mps, twist.angular_radps, twist.sideways_mps}, dt_);
      driven_m_[i] = sideways_ ? speed_of(twist) * dt_ + swing_ * std::abs(twist.angular_radps) * dt_
                               : std::sqrt(twist.linear_mps * twist.linear_mps + across_mps * across_mps) * dt_;
    }
  }

  /// One step along the arcs that were set.
  void step() {
    for (Arc<double>& arc : arcs_) arc.step(sideways_);
  }

  /// From vehicle i's nearest disc centre.
  double distance_m(std::size_t i, Point2 p) const {
    const Arc<double>& arc = arcs_[i];
    return std::sqrt(is_disc(scene_)
                         ? disc_distance2(arc.x, arc.y, p)
                         : outline_distance2(scene_.discs_ahead_m, arc.x, arc.y, arc.cos_yaw(), arc.sin_yaw(), p));
  }

 private:
  const Scene& scene_;
  double dt_;
  double swing_;
  std::vector<Twist2> wanted_;
  std::vector<kinematics::DriveState> states_;
  std::vector<Arc<double>> arcs_;
  std::vector<double> driven_m_;  // in one step
  bool is_steering_{false};       // in the last step in which some twist was not the wanted one
  bool sideways_{false};
};

/// Speeds of each vehicle's fastest point at the begin and at the end of a step.
struct Speeds {
  std::array<double, kBlock> was_mps, now_mps;
};

/// What the braking vehicle i touches in the step that ends at `t_s`: walls before peers before movers.
Obstruction touched(const Scene& scene, const Needed& needed, const Vehicles& vehicles, const Walls& walls,
                    const Speeds& speeds, std::size_t i, double t_s, double dt_s) {
  if (walls.least_m(i) < needed.wall - kTinyM) return Obstruction::kWall;

  for (const auto& [peer, needed_m] : needed.peers)
    for (const Point2 p : peer->stopping_in_map)
      if (vehicles.distance_m(i, p) - scene.radius_m - peer->radius_m < needed_m - kTinyM) return Obstruction::kPeer;

  for (const auto& [mover, needed_m] : needed.movers) {
    const bool stood = speeds.was_mps[i] <= kStandingMps;
    if (stood && mover->velocity_in_map != Point2{}) continue;
    const double moving_s =
        speeds.now_mps[i] > kStandingMps ? t_s : t_s - standing_since_s(speeds.was_mps[i], speeds.now_mps[i], dt_s);
    const double gap_m = vehicles.distance_m(i, mover->position_in_map + t_s * mover->velocity_in_map) -
                         scene.radius_m - mover->radius_m - mover->margin_m - mover->growth_mps * t_s -
                         (stood ? 0.0 : mover->reach_m(moving_s));
    if (gap_m < needed_m - kTinyM) return Obstruction::kMover;
  }

  return Obstruction::kNone;
}

/// Slows each vehicle down along its arc by what it can brake in a step, v' = max(0, v - a dt). Returns the twists that
/// are driven meanwhile: the means of before and after.
std::array<Twist2, kBlock> slow_down(Vehicles& vehicles, double slower_mps, Speeds& speeds) {
  std::array<Twist2, kBlock> mean;
  speeds.was_mps = speeds.now_mps;

  for (std::size_t i = 0; i < kBlock; ++i) {
    const double mps = speeds.now_mps[i];
    const double share = std::max(0.0, mps - slower_mps) / std::max(mps, kStoodMps);
    const double half = 0.5 * (1.0 + share);
    const Twist2 was = vehicles.twist(i);

    mean[i] = {half * was.linear_mps, half * was.angular_radps, half * was.sideways_mps};
    vehicles.set(i, {share * was.linear_mps, share * was.angular_radps, share * was.sideways_mps});
    speeds.now_mps[i] = fastest_point_mps(vehicles.twist(i), vehicles.swing());
  }

  return mean;
}

/// One step towards the wanted twist, then braking until all stand or have touched something.
void brake(const Scene& scene, const Needed& needed, const DwaSettings& settings, const Twist2* wanted,
           std::size_t count, Obstruction* out) {
  const double dt_s = settings.step_s;
  const double slower_mps = settings.braking_share * scene.limits.max_deceleration_mps2 * dt_s;
  Vehicles vehicles(scene, wanted, count, dt_s);
  Walls walls(scene, needed.wall_gaps_m, needed.wall);
  std::array<bool, kBlock> is_done{};

  std::size_t left = count;
  const auto finish = [&](std::size_t i, Obstruction found) {
    is_done[i] = true;
    out[i] = found;
    walls.leave(i);
    --left;
  };

  // The first step takes up the command: it is driven with the mean of the twist in force and the one taken up.
  vehicles.follow(false);
  vehicles.set_steps([&](std::size_t i) {
    const Twist2 &now = scene.twist, &then = vehicles.twist(i);
    return Twist2{0.5 * (now.linear_mps + then.linear_mps), 0.5 * (now.angular_radps + then.angular_radps),
                  0.5 * (now.sideways_mps + then.sideways_mps)};
  });

  Speeds speeds;
  for (std::size_t i = 0; i < kBlock; ++i)
    speeds.was_mps[i] = speeds.now_mps[i] = fastest_point_mps(vehicles.twist(i), vehicles.swing());

  const bool stands = fastest_point_mps(scene.twist, vehicles.swing()) < kStoodMps;

  // Some need not be looked at further.
  for (std::size_t i = 0; i < count; ++i) {
    if (stands && speeds.now_mps[i] < kStoodMps)
      finish(i, Obstruction::kNone);
    else if (needed.is_person_beside && speeds.now_mps[i] > kBesidePersonMps)
      finish(i, Obstruction::kMover);
  }

  // Then all brake, until each sample is finished.
  double t_s = 0.0;
  while (left > 0) {
    t_s += dt_s;
    vehicles.step();
    walls.look(vehicles.arcs(), vehicles.driven_m());

    for (std::size_t i = 0; i < count; ++i) {
      if (is_done[i]) continue;
      const Obstruction found = touched(scene, needed, vehicles, walls, speeds, i, t_s, dt_s);
      if (found != Obstruction::kNone || speeds.now_mps[i] < kStoodMps) finish(i, found);
    }

    const std::array<Twist2, kBlock> mean = slow_down(vehicles, slower_mps, speeds);
    vehicles.set_steps([&](std::size_t i) { return mean[i]; });
  }
}

/// Metres to the path's nearest point, in the single precision of the batched version.
float path_distance_m(const std::vector<Point2>& path_in_map, Point2 base_in_map, const Arc<double>& arc) {
  const auto x = static_cast<float>(arc.x - base_in_map.x);
  const auto y = static_cast<float>(arc.y - base_in_map.y);

  float nearest2 = std::numeric_limits<float>::infinity();
  for (const Point2 p : path_in_map) {
    const float dx = x - static_cast<float>(p.x - base_in_map.x);
    const float dy = y - static_cast<float>(p.y - base_in_map.y);
    nearest2 = std::min(nearest2, dx * dx + dy * dy);
  }

  return std::sqrt(nearest2);
}

/// The block's samples, driven to the horizon.
class Block {
 public:
  Block(const Scene& scene, const Needed& needed, const Aim& aim, const DwaSettings& settings, const Twist2* wanted,
        std::size_t count, Rollout* out)
      : scene_(scene),
        needed_(needed),
        aim_(aim),
        settings_(settings),
        count_(count),
        out_(out),
        vehicles_(scene, wanted, count, settings.step_s),
        walls_(scene, needed.wall_gaps_m, aim.wall_cap_m) {
    const geometry::Pose2& base = scene.base_in_map;
    const double cap_m = aim.mover_cap_m;
    for (std::size_t i = 0; i < count; ++i) {
      const Twist2& twist = wanted[i];
      out[i].sample = {twist.linear_mps,
                       twist.angular_radps,
                       twist.sideways_mps,
                       base.x,
                       base.y,
                       geometry::wrap(base.yaw),
                       base.x,
                       base.y,
                       aim.wall_cap_m,
                       cap_m,
                       cap_m,
                       cap_m,
                       0.0};
      out[i].moves = fastest_point_mps(twist, vehicles_.swing()) > kStandingMps;
    }
  }

  /// Drives all to the horizon: take up the twist, step, look at walls, then at all else.
  void run() {
    bool is_changing = true;
    for (int k = 1; k <= settings_.steps(); ++k) {
      if (is_changing) {
        is_changing = vehicles_.follow(true) || k == 1;
        vehicles_.set_steps([&](std::size_t i) { return vehicles_.twist(i); });
      }

      vehicles_.step();
      if (k <= settings_.last_wall_step(aim_)) meet_walls();
      for (std::size_t i = 0; i < count_; ++i) look(i, k);
    }

    finish();
  }

 private:
  /// A sample that moves and hits a wall is not followed further.
  void meet_walls() {
    walls_.look(vehicles_.arcs(), vehicles_.driven_m());

    for (std::size_t i = 0; i < kBlock; ++i) {
      Rollout& it = out_[std::min(i, count_ - 1)];
      if (!(walls_.least_m(i) < std::min(0.0, needed_.wall))) continue;
      it.collision = Obstruction::kWall;
      if (it.moves) walls_.leave(i);
    }
  }

  /// Sample i at step k: movers where they will be, the pose after the heading time, the path.
  void look(std::size_t i, int k) {
    Sample<double>& sample = out_[i].sample;
    const double t_s = k * settings_.step_s;
    for (const Mover* mover : needed_.foreseen)
      meet(i, mover->position_in_map + t_s * mover->velocity_in_map, mover->radius_m, mover->margin_m,
           mover->foreseen_growth_m(t_s),
           mover->velocity_in_map == Point2{} ? sample.standing_gap_m : sample.moving_gap_m);

    const Arc<double>& arc = vehicles_.arcs()[i];
    if (k == settings_.look_step()) {
      sample.look_x_m = arc.x;
      sample.look_y_m = arc.y;
      sample.look_yaw_rad = geometry::bearing_rad<double>(arc.sin_yaw(), arc.cos_yaw());
    }

    if (!aim_.path_in_map.empty() && k % kPathEverySteps == 0)
      sample.path_distance_m += path_distance_m(aim_.path_in_map, scene_.base_in_map.position(), arc);
  }

  /// A mover at its predicted place, for sample i.
  void meet(std::size_t i, Point2 there_in_map, double radius_m, double margin_m, double growth_m, double& gap_m) {
    Rollout& it = out_[i];
    const double distance_m = vehicles_.distance_m(i, there_in_map) - scene_.radius_m - radius_m;
    gap_m = std::min(gap_m, distance_m);
    it.sample.mover_gap_m = std::min(it.sample.mover_gap_m, distance_m - margin_m - growth_m);
    if (distance_m < 0.0 && it.collision != Obstruction::kWall) it.collision = Obstruction::kMover;
  }

  /// Horizon, walls, and the mean path distance.
  void finish() {
    const int path_looks = aim_.path_in_map.empty() ? 0 : settings_.steps() / kPathEverySteps;
    for (std::size_t i = 0; i < count_; ++i) {
      Sample<double>& sample = out_[i].sample;
      sample.end_x_m = vehicles_.arcs()[i].x;
      sample.end_y_m = vehicles_.arcs()[i].y;
      sample.wall_gap_m = walls_.least_m(i);
      if (path_looks > 0) sample.path_distance_m /= path_looks;
    }
  }

  const Scene& scene_;
  const Needed& needed_;
  const Aim& aim_;
  const DwaSettings& settings_;
  std::size_t count_;

  Rollout* out_;
  Vehicles vehicles_;
  Walls walls_;
};

/// Added in the order of the batched version, which adds the samples of one place in all blocks first: the last bit of
/// a sum depends on the order.
double sum_of(const std::vector<double>& numbers) {
  double sum = 0.0;
  for (std::size_t place = 0; place < kBlock; ++place) {
    double sum_of_place = 0.0;
    for (std::size_t i = place; i < numbers.size(); i += kBlock) sum_of_place += numbers[i];
    sum += sum_of_place;
  }

  return sum;
}

}  // namespace

std::vector<Obstruction> obstructions(const Scene& scene, const Needed& needed, const std::vector<Twist2>& wanted,
                                      const DwaSettings& settings) {
  std::vector<Obstruction> found(wanted.size());
  for (std::size_t first = 0; first < wanted.size(); first += kBlock)
    brake(scene, needed, settings, wanted.data() + first, std::min(kBlock, wanted.size() - first),
          found.data() + first);
  return found;
}

std::vector<Rollout> roll_out(const Scene& scene, const Needed& needed, const std::vector<Twist2>& wanted,
                              const Aim& aim, const DwaSettings& settings) {
  std::vector<Rollout> out(wanted.size());
  for (std::size_t first = 0; first < wanted.size(); first += kBlock)
    Block(scene, needed, aim, settings, wanted.data() + first, std::min(kBlock, wanted.size() - first),
          out.data() + first)
        .run();
  return out;
}

Choice choose(const Scene& scene, const Aim& aim, const Variant& variant, const DwaSettings& settings) {
  const Needed needed = needed_gaps(scene, settings);
  Choice choice;
  const std::vector<Twist2> wanted = choice.without_leaving(speed_window(scene, settings), scene, settings);
  const std::vector<Twist2> stoppable =
      choice.without_obstructed(wanted, obstructions(scene, needed, wanted, settings));

  std::vector<Sample<double>> samples;
  std::vector<bool> admitted;
  for (const Rollout& rollout : roll_out(scene, needed, stoppable, aim, settings)) {
    samples.push_back(rollout.sample);
    admitted.push_back(choice.admit(rollout.moves, rollout.collision));
  }

  const auto count = static_cast<double>(std::count(admitted.begin(), admitted.end(), true));

  std::vector<double> totals(samples.size(), 0.0), scores(samples.size());
  for (const WeightedCritic& weighted : variant.critics) {
    std::vector<double> admitted_scores(samples.size(), 0.0);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      scores[i] = weighted.critic.score(samples[i], aim);
      if (admitted[i]) admitted_scores[i] = scores[i];
    }

    const double sum = sum_of(admitted_scores);
    for (std::size_t i = 0; sum > 0.0 && i < samples.size(); ++i)
      totals[i] += weighted.weight * count / sum * scores[i];
  }

  const Preference preference(scene, variant, settings);
  double most = preference.least();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double total = preference.applied(totals[i], samples[i].linear_mps);
    if (!admitted[i] || !(total > most)) continue;
    most = total;
    choice.take(samples[i]);
  }

  return choice;
}

}  // namespace aisle::local_planner::plain
