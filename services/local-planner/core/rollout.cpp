#include "services/local-planner/core/rollout.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/geometry/wide_vectors.hpp"
#include "services/local-planner/core/lanes.hpp"
#include "services/local-planner/core/twist_lanes.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Twist2;

constexpr double kFarM = 1e9;
constexpr int kPathEvery = 4;             // steps; of a smooth trajectory that is enough

/// Somebody at one step, who may come near to some sample.
struct Foreseen {
  Point2 there_in_map;
  double radius_m;
  double margin_m;
  double growth_m;                        // by then
  bool stands;
  Obstruction kind;
  double reach_m;                         // centres farther apart than this earn nothing and cost nothing
};
using ForeseenByStep = std::vector<std::vector<Foreseen>>;

bool is_same(const Twist2& a, const Twist2& b) { return a.linear_mps == b.linear_mps && a.angular_radps == b.angular_radps && a.sideways_mps == b.sideways_mps; }

/// Whom the samples can meet at each step: predicted once, and left out where no sample can have come near by then.
ForeseenByStep foresee(const Scene& scene, const Needed& needed, const std::vector<Twist2>& wanted, const Aim& aim, int steps, double dt_s) {
  double fastest_mps = speed_of(scene.twist);
  for (const Twist2& twist : wanted) fastest_mps = std::max(fastest_mps, speed_of(twist));
  ForeseenByStep by_step(static_cast<std::size_t>(steps) + 1);
  const auto add = [&](std::size_t k, Foreseen whom) {
    constexpr double kRoundingM = 1e-6;
    whom.reach_m = scene.radius_m + whom.radius_m + aim.mover_cap_m + whom.margin_m + whom.growth_m + swing_m(scene) + kRoundingM;
    const Point2 apart = whom.there_in_map - scene.base_in_map.position();
    const double reach_m = whom.reach_m + fastest_mps * static_cast<double>(k) * dt_s;
    if (geometry::dot(apart, apart) < reach_m * reach_m) by_step[k].push_back(whom);
  };
  for (std::size_t k = 1; k < by_step.size(); ++k) {
    const double t = static_cast<double>(k) * dt_s;
    for (const Mover* mover : needed.foreseen)
      add(k, {mover->position_in_map + t * mover->velocity_in_map, mover->radius_m, mover->margin_m, mover->growth_mps * std::min(t, 1.0),
              mover->velocity_in_map == Point2{}, Obstruction::kMover, 0.0});
    for (const PeerMotion* peer : needed.met)
      add(k, {peer->intended_in_map[std::min(k, peer->intended_in_map.size() - 1)], peer->radius_m, 0.0, 0.0, false, Obstruction::kPeer, 0.0});
  }
  return by_step;
}

/// A bundle of samples: from the twist in force towards theirs, then on with it.
class Bundle {
 public:
  Bundle(const Scene& scene, const ForeseenByStep& foreseen, const Aim& aim, const DwaSettings& settings, const Twist2* wanted, std::size_t count)
      : scene_(scene), foreseen_(foreseen), aim_(aim), dt_(settings.step_s), look_(static_cast<int>(std::lround(settings.heading_s / dt_))),
        walls_until_(static_cast<int>(std::ceil(std::min(aim.walls_s, settings.horizon_s) / dt_ - 1e-9))),
        swing_(swing_m(scene)), least_wall_m_(std::min(0.0, wall_gap_m(scene))), count_(count), lanes_(scene.base_in_map), outlines_(scene), walls_(outlines_, aim.wall_cap_m),
        wanted_(wanted, count), twists_(scene.twist), steering_(scene.limits, scene.steering_rad, wanted_) {
    mover_m_.fill(aim.mover_cap_m);
    standing_m_.fill(aim.mover_cap_m);
    moving_m_.fill(aim.mover_cap_m);
    path_m_.fill(0.0);
    hit_.fill(static_cast<double>(Obstruction::kNone));
    looks_in_map_.fill(scene.base_in_map);
    is_done_.fill(false);
  }

  void run(Rollout* out) {
    const int steps = static_cast<int>(foreseen_.size()) - 1;
    for (int k = 1; k <= steps && left_ > 0; ++k) {
      if (is_changing_) follow(k);
      lanes_.step();
      outlines_.follow(lanes_);
      if (k <= walls_until_) meet_walls(out);
      meet(foreseen_[static_cast<std::size_t>(k)]);
      if (k == look_) look_around();
      if (!aim_.path_in_map.empty() && k % kPathEvery == 0) compare_with_path();
    }
    for (std::size_t i = 0; i < count_; ++i) {
      if (is_done_[i]) continue;
      out[i] = so_far(i, static_cast<Obstruction>(static_cast<int>(hit_[i])));
      out[i].sample.end_in_map = {lanes_.x[i], lanes_.y[i]};
      if (path_looks_ > 0) out[i].sample.path_distance_m = path_m_[i] / path_looks_;
    }
  }

 private:
  /// Twists change until they are what is wanted, or nothing comes nearer to it any more.
  void follow(int k) {
    is_changing_ = k == 1;
    const TwistLanes before = twists_;
    if (count_differing(twists_, wanted_) > 0) {
      if (scene_.limits.model == kinematics::Model::kDifferential) follow_differential(twists_, wanted_, scene_.limits, dt_);
      else if (scene_.limits.model == kinematics::Model::kTricycle) steering_.follow(twists_, wanted_, scene_.limits, dt_);
      else follow_one_by_one();
    }
    is_changing_ = is_changing_ || steering_.is_turning() || count_differing(twists_, before) > 0;
    driven_m(twists_, swing_, dt_, driven_m_);
    lanes_.set_steps(twists_.linear_mps, twists_.angular_radps, twists_.sideways_mps, dt_);
  }

  void follow_one_by_one() {
    for (std::size_t i = 0; i < kLanes; ++i)
      if (!is_same(twists_.at(i), wanted_.at(i))) twists_.set(i, kinematics::follow({twists_.at(i), 0.0}, wanted_.at(i), scene_.limits, dt_).twist);
  }

  /// Where each vehicle is after the heading time.
  void look_around() {
    Lane yaw_rad;
    lanes_.find_yaws_rad(yaw_rad);
    for (std::size_t i = 0; i < count_; ++i)
      if (!is_done_[i]) looks_in_map_[i] = {lanes_.x[i], lanes_.y[i], yaw_rad[i]};
  }

  void meet_walls(Rollout* out) {
    if (!walls_.look(outlines_, driven_m_)) return;
    const Lane& gaps = walls_.least_gaps_m();
    if (count_less(gaps, least_wall_m_) == done_) return;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (gaps[i] >= least_wall_m_ || is_done_[i]) continue;
      is_done_[i] = true;
      ++done_;
      walls_.leave(i);
      if (i >= count_) continue;
      out[i] = so_far(i, Obstruction::kWall);
      --left_;
    }
  }

  AISLE_WIDE_VECTORS static int count_less(const Lane& gaps, double least_m) {
    int less = 0;
    for (std::size_t i = 0; i < kLanes; ++i) less += gaps[i] < least_m ? 1 : 0;
    return less;
  }

  void meet(const std::vector<Foreseen>& all) {
    if (all.empty()) return;
    const Box box(lanes_);
    Lane squared;
    for (const Foreseen& whom : all) {
      if (box.distance2(whom.there_in_map) >= whom.reach_m * whom.reach_m) continue;
      outlines_.distances2_to(whom.there_in_map, squared);
      meet(whom, squared, whom.stands ? standing_m_ : moving_m_);
    }
  }

  /// Loops of one line each, over values that do not alias: so they become vectors.
  AISLE_WIDE_VECTORS void meet(const Foreseen& whom, const Lane& squared, Lane& gap_of_kind) {
    const double own_m = scene_.radius_m;
    const double its_m = whom.radius_m;
    const double margin_m = whom.margin_m;
    const double growth_m = whom.growth_m;
    const auto kind = static_cast<double>(whom.kind);
    Lane distance;
    for (std::size_t i = 0; i < kLanes; ++i) distance[i] = std::sqrt(squared[i]) - own_m - its_m;
    for (std::size_t i = 0; i < kLanes; ++i) gap_of_kind[i] = least(gap_of_kind[i], distance[i]);
    for (std::size_t i = 0; i < kLanes; ++i) mover_m_[i] = least(mover_m_[i], distance[i] - margin_m - growth_m);
    for (std::size_t i = 0; i < kLanes; ++i) hit_[i] = distance[i] < 0.0 ? kind : hit_[i];
  }

  AISLE_WIDE_VECTORS void compare_with_path() {
    constexpr std::size_t kTogether = 4;    // points; each pass over the lanes costs loads and stores
    const std::vector<Point2>& path = aim_.path_in_map;
    const auto at = [&](std::size_t j) { return path[std::min(j, path.size() - 1)]; };
    Lane nearest;
    nearest.fill(kFarM * kFarM);
    for (std::size_t first = 0; first < path.size(); first += kTogether) {
      const Point2 a = at(first), b = at(first + 1), c = at(first + 2), d = at(first + 3);
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double x = lanes_.x[i], y = lanes_.y[i];
        const double to_a = (x - a.x) * (x - a.x) + (y - a.y) * (y - a.y), to_b = (x - b.x) * (x - b.x) + (y - b.y) * (y - b.y);
        const double to_c = (x - c.x) * (x - c.x) + (y - c.y) * (y - c.y), to_d = (x - d.x) * (x - d.x) + (y - d.y) * (y - d.y);
        nearest[i] = least(nearest[i], least(least(to_a, to_b), least(to_c, to_d)));
      }
    }
    for (std::size_t i = 0; i < kLanes; ++i) path_m_[i] += std::sqrt(nearest[i]);
    ++path_looks_;
  }

  Rollout so_far(std::size_t i, Obstruction collides) const {
    return {{wanted_.at(i), looks_in_map_[i], scene_.base_in_map.position(), walls_.least_gaps_m()[i], mover_m_[i], standing_m_[i], moving_m_[i], 0.0}, collides};
  }

  const Scene& scene_;
  const ForeseenByStep& foreseen_;
  const Aim& aim_;
  double dt_;
  int look_, walls_until_;
  double swing_, least_wall_m_;
  std::size_t count_;
  std::size_t left_{count_};
  Lanes lanes_;
  Outlines outlines_;
  WallWatch walls_;
  TwistLanes wanted_, twists_;
  SteeringLanes steering_;                // of a tricycle
  bool is_changing_{true};
  Lane driven_m_;
  Lane mover_m_, standing_m_, moving_m_, path_m_, hit_;
  int path_looks_{0};
  std::array<geometry::Pose2, kLanes> looks_in_map_;
  std::array<bool, kLanes> is_done_;
  int done_{0};
};

}  // namespace

std::vector<Rollout> roll_out(const Scene& scene, const Needed& needed, const std::vector<Twist2>& wanted, const Aim& aim, const DwaSettings& settings) {
  const int steps = static_cast<int>(std::lround(settings.horizon_s / settings.step_s));
  const ForeseenByStep foreseen = foresee(scene, needed, wanted, aim, steps, settings.step_s);
  std::vector<Rollout> rollouts(wanted.size());
  for (std::size_t first = 0; first < wanted.size(); first += kLanes)
    Bundle(scene, foreseen, aim, settings, wanted.data() + first, std::min(kLanes, wanted.size() - first)).run(rollouts.data() + first);
  return rollouts;
}

}  // namespace aisle::local_planner
