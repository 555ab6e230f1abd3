#include "services/local-planner/core/rollout.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/bearings.hpp"
#include "services/local-planner/core/motion.hpp"
#include "services/local-planner/core/walls.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Batch;
using geometry::least;
using geometry::Point2;
using geometry::Twist2;

constexpr double kRoundingM = 1e-6;

/// A mover's predicted position at one time step.
struct Predicted {
  Point2 position_in_map;
  double radius_m;
  double margin_m;
  double growth_m;  // of the uncertainty, by then
  bool stands;
  double reach_m;  // from a base farther than this, it changes nothing
};

using PredictedByStep = std::vector<std::vector<Predicted>>;

/// The positions that the samples can meet at each step: predicted once a cycle, without those that no sample can have
/// come near to by then.
PredictedByStep predict(const Scene& scene, const Needed& needed, const std::vector<Twist2>& wanted, const Aim& aim,
                        int steps, double dt_s) {
  double fastest_mps = speed_of(scene.twist);
  for (const Twist2& twist : wanted) fastest_mps = std::max(fastest_mps, speed_of(twist));
  const double swing = swing_m(scene);

  PredictedByStep by_step(static_cast<std::size_t>(steps) + 1);
  const auto add = [&](std::size_t k, Predicted it) {
    it.reach_m = scene.radius_m + it.radius_m + aim.mover_cap_m + it.margin_m + it.growth_m + swing + kRoundingM;
    const Point2 apart = it.position_in_map - scene.base_in_map.position();
    const double reach_m = it.reach_m + fastest_mps * static_cast<double>(k) * dt_s;
    if (geometry::dot(apart, apart) < reach_m * reach_m) by_step[k].push_back(it);
  };

  for (std::size_t k = 1; k < by_step.size(); ++k) {
    const double t = static_cast<double>(k) * dt_s;
    for (const Mover* mover : needed.foreseen)
      add(k, {mover->position_in_map + t * mover->velocity_in_map, mover->radius_m, mover->margin_m,
              mover->foreseen_growth_m(t), mover->velocity_in_map == Point2{}, 0.0});
  }

  return by_step;
}

/// Eight numbers of single precision: those of two batches.
using Singles = float __attribute__((vector_size(2 * geometry::kBatch * sizeof(float))));
constexpr std::size_t kSingles = kBatches / 2;  // of a block

[[gnu::always_inline]] inline Singles narrowed(const Batch& first, const Batch& second) {
  using Four = float __attribute__((vector_size(geometry::kBatch * sizeof(float))));
  const Four a = __builtin_convertvector(first, Four);
  const Four b = __builtin_convertvector(second, Four);

  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// The path seen from the base, in axes of the map: near enough for single precision.
struct NearPoint {
  float x_m, y_m;
};

/// The path's points less the base.
std::vector<NearPoint> near_path(const std::vector<Point2>& path_in_map, const Point2& base_in_map) {
  std::vector<NearPoint> path;
  path.reserve(path_in_map.size());
  for (const Point2 p : path_in_map)
    path.push_back({static_cast<float>(p.x - base_in_map.x), static_cast<float>(p.y - base_in_map.y)});

  return path;
}

/// A block of samples: each takes up its twist within the vehicle's limits, then drives on with it to the horizon.
class RolloutBlock {
 public:
  RolloutBlock(const Scene& scene, const Needed& needed, const PredictedByStep& predicted,
               const std::vector<NearPoint>& path, const Aim& aim, const DwaSettings& settings, const Twist2* wanted,
               SampleBlock& out)
      : scene_(scene),
        predicted_(predicted),
        path_(path),
        dt_(settings.step_s),
        look_step_(settings.look_step()),
        last_wall_step_(settings.last_wall_step(aim)),
        swing_(swing_m(scene)),
        least_wall_m_(std::min(0.0, needed.wall)),
        out_(out),
        arcs_(scene.base_in_map),
        outlines_(scene, arcs_),
        walls_(outlines_, needed.wall_gaps_m, aim.wall_cap_m),
        wanted_(wanted, out.count),
        twists_(scene.twist),
        steering_(scene.limits, scene.steering_rad, wanted_) {
    begin(aim);
  }

  /// Drives all to the horizon: take up the twist, step, look at walls, movers, peers and the path.
  void run() {
    const int steps = static_cast<int>(predicted_.size()) - 1;
    for (int k = 1; k <= steps && left_ > 0; ++k) {
      if (is_changing_) follow(k);
      arcs_.step();
      if (k <= last_wall_step_ && walls_.look(driven_m_)) meet_walls();
      meet(predicted_[static_cast<std::size_t>(k)]);
      if (k == look_step_) look();
      if (!path_.empty() && k % kPathEverySteps == 0) compare_with_path();
    }

    finish();
  }

 private:
  /// All samples at the base, with the most that gaps can be.
  void begin(const Aim& aim) {
    const Batch cap_m = Batch{} + aim.mover_cap_m;
    const geometry::Pose2& base = scene_.base_in_map;
    for (std::size_t b = 0; b < kBatches; ++b) {
      Sample<Batch>& sample = out_.batches[b];
      const Twist<Batch>& twist = wanted_.batches[b];
      sample.linear_mps = twist.linear_mps;
      sample.angular_radps = twist.angular_radps;
      sample.sideways_mps = twist.sideways_mps;
      sample.look_x_m = Batch{} + base.x;
      sample.look_y_m = Batch{} + base.y;
      sample.look_yaw_rad = Batch{} + geometry::wrap(base.yaw);
      sample.mover_gap_m = sample.standing_gap_m = sample.moving_gap_m = cap_m;
      sample.path_distance_m = Batch{};
      hit_[b] = Batch{};
    }

    out_.collisions.fill(Obstruction::kNone);

    for (std::size_t i = 0; i < kBlock; ++i) {
      const Twist2 twist = wanted_.at(i);
      out_.moves[i] = std::max(speed_of(twist), swing_ * std::abs(twist.angular_radps)) > kStandingMps;
    }
  }

  /// Twists change until they are the wanted ones, or nothing brings them nearer any more.
  void follow(int k) {
    is_changing_ = k == 1;
    const TwistBlock before = twists_;

    if (differ(twists_, wanted_)) {
      if (scene_.limits.model == kinematics::Model::kDifferential)
        follow_differential(twists_, wanted_, scene_.limits, dt_);
      else if (scene_.limits.model == kinematics::Model::kTricycle)
        steering_.follow(twists_, wanted_, scene_.limits, dt_);
      else
        follow_one_by_one();
    }

    is_changing_ = is_changing_ || steering_.is_turning() || differ(twists_, before);
    find_driven_m(twists_, swing_, dt_, driven_m_);
    arcs_.set_steps(twists_, dt_);
  }

  /// For models without a batched version; `kinematics::follow` for each sample.
  void follow_one_by_one() {
    for (std::size_t i = 0; i < kBlock; ++i)
      if (!is_same(twists_.at(i), wanted_.at(i)))
        twists_.set(i, kinematics::follow({twists_.at(i), 0.0}, wanted_.at(i), scene_.limits, dt_).twist);
  }

  /// The poses after the heading time.
  AISLE_BATCHED void look() {
    for (std::size_t b = 0; b < kBatches; ++b) {
      const Arc<Batch>& arc = arcs_.batches[b];
      Sample<Batch>& sample = out_.batches[b];
      sample.look_x_m = arc.x;
      sample.look_y_m = arc.y;
      sample.look_yaw_rad = geometry::bearing_rad(arc.sin_yaw(), arc.cos_yaw());
    }
  }

  /// A sample that moves and hits a wall is not followed further.
  void meet_walls() {
    if (count_at_walls() == at_walls_) return;

    for (std::size_t i = 0; i < kBlock; ++i) {
      if (!(walls_.least_m()[i] < least_wall_m_) || out_.collisions[i] == Obstruction::kWall) continue;

      out_.collisions[i] = Obstruction::kWall;
      ++at_walls_;

      if (!out_.moves[i]) continue;
      walls_.leave(i);
      if (i < out_.count) --left_;
    }
  }

  /// How many samples have too little room to a wall.
  AISLE_BATCHED int count_at_walls() const {
    geometry::BatchMask at_walls{};
    for (std::size_t b = 0; b < kBatches; ++b) at_walls += walls_.least_m().batch(b) < least_wall_m_;
    return geometry::count_of(at_walls);
  }

  /// The movers that the samples meet at this step; headings are computed only when something is near.
  void meet(const std::vector<Predicted>& all) {
    if (all.empty()) return;
    const Box box = Box::around(arcs_);

    bool is_first = true;
    for (const Predicted& it : all) {
      if (box.distance2(it.position_in_map) >= it.reach_m * it.reach_m) continue;
      if (is_first) outlines_.find_headings();
      is_first = false;
      meet(it);
    }
  }

  /// One mover, for all samples.
  AISLE_BATCHED void meet(const Predicted& it) {
    const double own_m = scene_.radius_m;
    for (std::size_t b = 0; b < kBatches; ++b) {
      Sample<Batch>& sample = out_.batches[b];
      const Batch distance_m = geometry::square_root(outlines_.distance2(b, it.position_in_map)) - own_m - it.radius_m;
      Batch& gap_m = it.stands ? sample.standing_gap_m : sample.moving_gap_m;
      gap_m = least(gap_m, distance_m);
      sample.mover_gap_m = least<Batch>(sample.mover_gap_m, distance_m - it.margin_m - it.growth_m);
      hit_[b] = distance_m < 0.0 ? Batch{} + 1.0 : hit_[b];
    }
  }

  /// Adds to each sample's path distance how far it is from the path's nearest point now.
  AISLE_BATCHED void compare_with_path() {
    constexpr float kFarM2 = 1e30F;
    const double base_x = scene_.base_in_map.x;
    const double base_y = scene_.base_in_map.y;
    Singles x_m[kSingles], y_m[kSingles], nearest_m2[kSingles];

    // The bases, in single precision, from where all began.
    for (std::size_t k = 0; k < kSingles; ++k) {
      const Arc<Batch>&first = arcs_.batches[2 * k], &second = arcs_.batches[2 * k + 1];
      x_m[k] = narrowed(first.x - base_x, second.x - base_x);
      y_m[k] = narrowed(first.y - base_y, second.y - base_y);
      nearest_m2[k] = Singles{} + kFarM2;
    }

    // The nearest point of the path to each.
    for (const NearPoint& p : path_)

      for (std::size_t k = 0; k < kSingles; ++k) {
        const Singles x = x_m[k] - p.x_m;
        const Singles y = y_m[k] - p.y_m;
        nearest_m2[k] = least<Singles>(nearest_m2[k], x * x + y * y);
      }
    for (std::size_t k = 0; k < kSingles; ++k)
      for (std::size_t i = 0; i < 2 * geometry::kBatch; ++i)
        out_.batches[2 * k + i / geometry::kBatch].path_distance_m[i % geometry::kBatch] +=
            static_cast<double>(std::sqrt(nearest_m2[k][i]));

    ++path_looks_;
  }

  /// Horizon, walls and mean path distance, and with what each sample collides.
  AISLE_BATCHED void finish() {
    for (std::size_t b = 0; b < kBatches; ++b) {
      Sample<Batch>& sample = out_.batches[b];
      sample.end_x_m = arcs_.batches[b].x;
      sample.end_y_m = arcs_.batches[b].y;
      sample.wall_gap_m = walls_.least_m().batch(b);
      if (path_looks_ > 0) sample.path_distance_m /= static_cast<double>(path_looks_);
    }

    for (std::size_t i = 0; i < kBlock; ++i)
      if (out_.collisions[i] == Obstruction::kNone && hit_[i / geometry::kBatch][i % geometry::kBatch] > 0.0)
        out_.collisions[i] = Obstruction::kMover;
  }

  const Scene& scene_;
  const PredictedByStep& predicted_;
  const std::vector<NearPoint>& path_;
  double dt_;
  int look_step_, last_wall_step_;
  double swing_, least_wall_m_;
  SampleBlock& out_;
  std::size_t left_{out_.count};  // samples that can still be chosen
  ArcBlock arcs_;
  Outlines outlines_;
  WallGaps walls_;

  TwistBlock wanted_, twists_;
  SteeringBlock steering_;  // of a tricycle
  bool is_changing_{true};
  PerSample driven_m_;                          // in one step
  alignas(sizeof(Batch)) Batch hit_[kBatches];  // 1: a mover
  int path_looks_{0}, at_walls_{0};
};

}  // namespace

std::vector<SampleBlock> batched::roll_out(const Scene& scene, const Needed& needed, const std::vector<Twist2>& wanted,
                                           const Aim& aim, const DwaSettings& settings) {
  const PredictedByStep predicted = predict(scene, needed, wanted, aim, settings.steps(), settings.step_s);
  const std::vector<NearPoint> path = near_path(aim.path_in_map, scene.base_in_map.position());

  std::vector<SampleBlock> all((wanted.size() + kBlock - 1) / kBlock);
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].count = std::min(kBlock, wanted.size() - k * kBlock);
    RolloutBlock(scene, needed, predicted, path, aim, settings, wanted.data() + k * kBlock, all[k]).run();
  }

  return all;
}

}  // namespace aisle::local_planner
