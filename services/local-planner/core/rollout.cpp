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
using geometry::Pose2;
using geometry::Twist2;

constexpr double kStandingMps = 0.05;
constexpr int kPathEvery = 4;  // steps; of a smooth trajectory that is enough

/// Somebody at one step, who may come near to some sample.
struct Foreseen {
  Point2 there_in_map;
  double radius_m;
  double margin_m;
  double growth_m;  // by then
  bool stands;
  Obstruction kind;
  double reach_m;  // centres farther apart than this earn nothing and cost nothing
};
using ForeseenByStep = std::vector<std::vector<Foreseen>>;

bool is_same(const Twist2& a, const Twist2& b) {
  return a.linear_mps == b.linear_mps && a.angular_radps == b.angular_radps && a.sideways_mps == b.sideways_mps;
}

/// Whom the samples can meet at each step: predicted once, and left out where no sample can have come near by then.
ForeseenByStep foresee(const Scene& scene, const Needed& needed, const std::vector<Twist2>& wanted, const Aim& aim,
                       int steps, double dt_s) {
  double fastest_mps = speed_of(scene.twist);
  for (const Twist2& twist : wanted) fastest_mps = std::max(fastest_mps, speed_of(twist));
  const double swing = swing_m(scene);
  ForeseenByStep by_step(static_cast<std::size_t>(steps) + 1);
  const auto add = [&](std::size_t k, Foreseen whom) {
    constexpr double kRoundingM = 1e-6;
    whom.reach_m =
        scene.radius_m + whom.radius_m + aim.mover_cap_m + whom.margin_m + whom.growth_m + swing + kRoundingM;
    const Point2 apart = whom.there_in_map - scene.base_in_map.position();
    const double reach_m = whom.reach_m + fastest_mps * static_cast<double>(k) * dt_s;
    if (geometry::dot(apart, apart) < reach_m * reach_m) by_step[k].push_back(whom);
  };
  for (std::size_t k = 1; k < by_step.size(); ++k) {
    const double t = static_cast<double>(k) * dt_s;
    for (const Mover* mover : needed.foreseen)
      add(k, {mover->position_in_map + t * mover->velocity_in_map, mover->radius_m, mover->margin_m,
              mover->growth_mps * std::min(t, 1.0), mover->velocity_in_map == Point2{}, Obstruction::kMover, 0.0});
    for (const PeerMotion* peer : needed.met)
      add(k, {peer->intended_in_map[std::min(k, peer->intended_in_map.size() - 1)], peer->radius_m, 0.0, 0.0, false,
              Obstruction::kPeer, 0.0});
  }
  return by_step;
}

/// The way as seen from the base, in axes of the map: near enough for single precision, of which twice as many fit into
/// a vector.
struct NearPoint {
  float x_m, y_m;
};
using NearPath = std::vector<std::array<NearPoint, 4>>;  // each pass over the lanes costs loads and stores

NearPath near_path(const std::vector<Point2>& path_in_map, const Pose2& base_in_map) {
  NearPath path((path_in_map.size() + 3) / 4);
  for (std::size_t i = 0; i < 4 * path.size(); ++i) {
    const Point2 p = path_in_map[std::min(i, path_in_map.size() - 1)] - base_in_map.position();
    path[i / 4][i % 4] = {static_cast<float>(p.x), static_cast<float>(p.y)};
  }
  return path;
}

/// A bundle of samples: from the twist in force towards theirs, then on with it.
class Bundle {
 public:
  Bundle(const Scene& scene, const Needed& needed, const ForeseenByStep& foreseen, const NearPath& path, const Aim& aim,
         const DwaSettings& settings, const Twist2* wanted, Samples& out)
      : scene_(scene),
        foreseen_(foreseen),
        path_(path),
        dt_(settings.step_s),
        look_(static_cast<int>(std::lround(settings.heading_s / dt_))),
        walls_until_(static_cast<int>(std::ceil(std::min(aim.walls_s, settings.horizon_s) / dt_ - 1e-9))),
        swing_(swing_m(scene)),
        least_wall_m_(std::min(0.0, needed.wall)),
        out_(out),
        lanes_(scene.base_in_map),
        outlines_(scene),
        walls_(outlines_, needed.wall_gaps_m, aim.wall_cap_m),
        wanted_(wanted, out.count),
        twists_(scene.twist),
        steering_(scene.limits, scene.steering_rad, wanted_) {
    out_.linear_mps = wanted_.linear_mps, out_.angular_radps = wanted_.angular_radps,
    out_.sideways_mps = wanted_.sideways_mps;
    out_.mover_gap_m.fill(aim.mover_cap_m);
    out_.standing_gap_m.fill(aim.mover_cap_m);
    out_.moving_gap_m.fill(aim.mover_cap_m);
    out_.path_distance_m.fill(0.0);
    out_.look_x_m.fill(scene.base_in_map.x), out_.look_y_m.fill(scene.base_in_map.y),
        out_.look_yaw_rad.fill(geometry::wrap(scene.base_in_map.yaw));
    hit_.fill(static_cast<double>(Obstruction::kNone));
    out_.collides.fill(Obstruction::kNone);
    for (std::size_t i = 0; i < kLanes; ++i)
      out_.moves[i] = std::max(speed_of(wanted_.at(i)), swing_ * std::abs(wanted_.angular_radps[i])) > kStandingMps;
  }

  void run() {
    const int steps = static_cast<int>(foreseen_.size()) - 1;
    for (int k = 1; k <= steps && left_ > 0; ++k) {
      if (is_changing_) follow(k);
      lanes_.step();
      outlines_.follow(lanes_);
      if (k <= walls_until_) meet_walls();
      meet(foreseen_[static_cast<std::size_t>(k)]);
      if (k == look_) look_around();
      if (!path_.empty() && k % kPathEvery == 0) compare_with_path();
    }
    finish();
  }

 private:
  /// Twists change until they are what is wanted, or nothing comes nearer to it any more.
  void follow(int k) {
    is_changing_ = k == 1;
    const TwistLanes before = twists_;
    if (count_differing(twists_, wanted_) > 0) {
      if (scene_.limits.model == kinematics::Model::kDifferential)
        follow_differential(twists_, wanted_, scene_.limits, dt_);
      else if (scene_.limits.model == kinematics::Model::kTricycle)
        steering_.follow(twists_, wanted_, scene_.limits, dt_);
      else
        follow_one_by_one();
    }
    is_changing_ = is_changing_ || steering_.is_turning() || count_differing(twists_, before) > 0;
    driven_m(twists_, swing_, dt_, driven_m_);
    lanes_.set_steps(twists_.linear_mps, twists_.angular_radps, twists_.sideways_mps, dt_);
  }

  void follow_one_by_one() {
    for (std::size_t i = 0; i < kLanes; ++i)
      if (!is_same(twists_.at(i), wanted_.at(i)))
        twists_.set(i, kinematics::follow({twists_.at(i), 0.0}, wanted_.at(i), scene_.limits, dt_).twist);
  }

  /// Where each vehicle is after the heading time.
  void look_around() {
    out_.look_x_m = lanes_.x, out_.look_y_m = lanes_.y;
    lanes_.find_yaws_rad(out_.look_yaw_rad);
  }

  void meet_walls() {
    if (!walls_.look(outlines_, driven_m_)) return;
    const Lane& gaps = walls_.least_gaps_m();
    if (count_less(gaps, least_wall_m_) == at_walls_) return;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (gaps[i] >= least_wall_m_ || out_.collides[i] == Obstruction::kWall) continue;
      out_.collides[i] = Obstruction::kWall;
      ++at_walls_;
      if (!out_.moves[i]) continue;
      walls_.leave(i);
      if (i < out_.count) --left_;
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
      meet(whom, squared, whom.stands ? out_.standing_gap_m : out_.moving_gap_m);
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
    for (std::size_t i = 0; i < kLanes; ++i)
      out_.mover_gap_m[i] = least(out_.mover_gap_m[i], distance[i] - margin_m - growth_m);
    for (std::size_t i = 0; i < kLanes; ++i) hit_[i] = distance[i] < 0.0 ? kind : hit_[i];
  }

  AISLE_WIDE_VECTORS void compare_with_path() {
    std::array<float, kLanes> x_m, y_m, nearest_m2;
    for (std::size_t i = 0; i < kLanes; ++i)
      x_m[i] = static_cast<float>(lanes_.x[i] - scene_.base_in_map.x),
      y_m[i] = static_cast<float>(lanes_.y[i] - scene_.base_in_map.y);
    nearest_m2.fill(1e30F);
    for (const auto& [a, b, c, d] : path_) {
      for (std::size_t i = 0; i < kLanes; ++i) {
        const float to_a = squared(x_m[i] - a.x_m, y_m[i] - a.y_m), to_b = squared(x_m[i] - b.x_m, y_m[i] - b.y_m);
        const float to_c = squared(x_m[i] - c.x_m, y_m[i] - c.y_m), to_d = squared(x_m[i] - d.x_m, y_m[i] - d.y_m);
        const float to_ab = to_b < to_a ? to_b : to_a, to_cd = to_d < to_c ? to_d : to_c,
                    to_all = to_cd < to_ab ? to_cd : to_ab;
        nearest_m2[i] = to_all < nearest_m2[i] ? to_all : nearest_m2[i];
      }
    }
    for (std::size_t i = 0; i < kLanes; ++i) out_.path_distance_m[i] += static_cast<double>(std::sqrt(nearest_m2[i]));
    ++path_looks_;
  }
  static float squared(float x, float y) { return x * x + y * y; }

  void finish() {
    out_.end_x_m = lanes_.x, out_.end_y_m = lanes_.y;
    out_.wall_gap_m = walls_.least_gaps_m();
    for (std::size_t i = 0; path_looks_ > 0 && i < kLanes; ++i) out_.path_distance_m[i] /= path_looks_;
    for (std::size_t i = 0; i < kLanes; ++i)
      if (out_.collides[i] == Obstruction::kNone)
        out_.collides[i] = static_cast<Obstruction>(static_cast<int>(hit_[i]));
  }

  const Scene& scene_;
  const ForeseenByStep& foreseen_;
  const NearPath& path_;
  double dt_;
  int look_, walls_until_;
  double swing_, least_wall_m_;
  Samples& out_;
  std::size_t left_{out_.count};  // that can still be taken
  Lanes lanes_;
  Outlines outlines_;
  WallWatch walls_;
  TwistLanes wanted_, twists_;
  SteeringLanes steering_;  // of a tricycle
  bool is_changing_{true};
  Lane driven_m_, hit_;  // hit_: an Obstruction's number
  int path_looks_{0}, at_walls_{0};
};

}  // namespace

std::vector<Samples> roll_out(const Scene& scene, const Needed& needed, const std::vector<Twist2>& wanted,
                              const Aim& aim, const DwaSettings& settings) {
  const int steps = static_cast<int>(std::lround(settings.horizon_s / settings.step_s));
  const ForeseenByStep foreseen = foresee(scene, needed, wanted, aim, steps, settings.step_s);
  const NearPath path = near_path(aim.path_in_map, scene.base_in_map);
  std::vector<Samples> all((wanted.size() + kLanes - 1) / kLanes);
  for (std::size_t b = 0; b < all.size(); ++b) {
    all[b].count = std::min(kLanes, wanted.size() - b * kLanes);
    Bundle(scene, needed, foreseen, path, aim, settings, wanted.data() + b * kLanes, all[b]).run();
  }
  return all;
}

}  // namespace aisle::local_planner
