// The batched window is the plain one, to the bit: what stops each sample, what its trajectory meets, which is chosen.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <tuple>
#include <vector>

#include "common/geometry/footprint.hpp"
#include "services/local-planner/core/plain_window.hpp"
#include "services/local-planner/core/speed_window.hpp"
#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr int kScenes = 100;  // of each of the kinds below
constexpr double kHallM = 8.0;

struct Numbers {
  std::mt19937_64 random;
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  bool once_in(unsigned count) { return random() % count == 0; }
  Point2 place() { return {between(0.5, kHallM - 0.5), between(0.5, kHallM - 0.5)}; }
  /// So far from `p`, in any direction.
  Point2 beside(Point2 p, double low_m, double high_m) {
    const double away_m = between(low_m, high_m), angle_rad = between(-geometry::kPi, geometry::kPi);
    return p + away_m * Point2{std::cos(angle_rad), std::sin(angle_rad)};
  }
};

/// A hall with blocks, a vehicle's place, and beside it people who walk or stand and a vehicle that crosses.
struct World {
  grid::ClearanceField clearance;
  geometry::Pose2 base_in_map;
  std::vector<Mover> movers;
  std::vector<PeerMotion> peers;

  explicit World(Numbers& numbers) {
    grid::OccupancyGrid grid = hall(kHallM, kHallM);
    for (int i = 0; i < 4; ++i) {
      const Point2 p = numbers.place();
      block(grid, p.x, p.y, p.x + 0.5, p.y + 0.3);
    }
    clearance = grid::ClearanceField(grid, numbers.once_in(2) ? 1.0 : 5.0);
    for (int tries = 0; tries < 20 && !(clearance.clearance_m(base_in_map.position()) > 0.4); ++tries) {
      const Point2 p = numbers.place();
      base_in_map = {p.x, p.y, numbers.between(-3.1, 3.1)};
    }
    for (int people = static_cast<int>(numbers.random() % 5); people > 0; --people) add_person(numbers);
    if (!numbers.once_in(3)) add_peer(numbers);
  }

 private:
  void add_person(Numbers& numbers) {
    Mover mover;
    mover.position_in_map = numbers.beside(base_in_map.position(), 0.6, 4.0);
    if (!numbers.once_in(3)) mover.velocity_in_map = {numbers.between(-1.2, 1.2), numbers.between(-1.2, 1.2)};
    mover.may_walk = !numbers.once_in(4);
    mover.unseen_s = numbers.between(0.0, 0.3);
    movers.push_back(mover);
  }

  void add_peer(Numbers& numbers) {
    PeerMotion peer;
    const Point2 from = numbers.beside(base_in_map.position(), 0.8, 2.5);
    const Point2 way{numbers.between(-0.1, 0.1), numbers.between(-0.1, 0.1)};
    for (int k = 0; k < 5; ++k) peer.stopping_in_map.push_back(from + static_cast<double>(k) * way);
    peers.push_back(peer);
  }
};

using Kind = std::tuple<kinematics::Model, bool>;  // and is it a rectangle?

class AnyScene : public ::testing::TestWithParam<Kind> {
 protected:
  Scene scene(Numbers& numbers, const World& world) const {
    const auto [model, is_rectangle] = GetParam();
    const geometry::CoveringDiscs discs =
        geometry::covering_discs(is_rectangle ? geometry::rectangle(1.6, 0.8, 0.3) : geometry::disc(0.35));
    kinematics::Limits limits;
    limits.model = model;
    limits.axle.is_rear = numbers.once_in(2);
    Scene out{world.clearance, world.base_in_map,         {},           discs.radius_m,
              limits,          numbers.between(0.3, 1.2), world.movers, world.peers};
    out.discs_ahead_m = discs.ahead_m;
    if (!numbers.once_in(4)) out.twist = {numbers.between(-0.2, 1.2), numbers.between(-1.2, 1.2), 0.0};
    if (model == kinematics::Model::kOmnidirectional && numbers.once_in(2)) out.twist.sideways_mps = 0.3;
    if (model == kinematics::Model::kTricycle) out.steering_rad = numbers.between(-1.0, 1.0);
    return out;
  }

  Aim aim(Numbers& numbers, const Scene& scene) const {
    Aim out;
    out.target_in_map = numbers.place(), out.sub_target_in_map = numbers.place();
    if (numbers.once_in(2)) out.walls_s = numbers.between(0.3, 2.5);
    for (int k = static_cast<int>(numbers.random() % 12); k > 0; --k)
      out.path_in_map.push_back(scene.base_in_map.position() + Point2{0.2 * k, numbers.between(-0.1, 0.1)});
    return out;
  }

  DwaSettings settings(Numbers& numbers) const {
    DwaSettings out;
    out.linear_samples = 3 + static_cast<int>(numbers.random() % 8);
    out.angular_samples = 3 + static_cast<int>(numbers.random() % 12);
    return out;
  }
};

std::vector<std::uint64_t> bits_of(const Sample<double>& sample) {
  std::vector<std::uint64_t> bits(sizeof(sample) / sizeof(std::uint64_t));
  std::memcpy(bits.data(), &sample, sizeof(sample));
  return bits;
}

TEST_P(AnyScene, StopsTheSameSamples) {
  Numbers numbers{std::mt19937_64(1)};
  int stopped[4]{};
  for (int round = 0; round < kScenes; ++round) {
    const World world(numbers);
    const Scene at = scene(numbers, world);
    const DwaSettings with = settings(numbers);
    const Needed needed = needed_gaps(at, with);
    const std::vector<geometry::Twist2> wanted = speed_window(at, with);
    const std::vector<Obstruction> expected = plain::obstructions(at, needed, wanted, with);
    ASSERT_EQ(batched::obstructions(at, needed, wanted, with), expected) << "round " << round;
    for (const Obstruction found : expected) ++stopped[static_cast<int>(found)];
  }
  for (int kind = 0; kind < 4; ++kind) EXPECT_GT(stopped[kind], 20) << "of kind " << kind;
}

TEST_P(AnyScene, MeetsTheSameOnEachTrajectory) {
  Numbers numbers{std::mt19937_64(2)};
  int met[4]{}, near_walls = 0;
  for (int round = 0; round < kScenes; ++round) {
    const World world(numbers);
    const Scene at = scene(numbers, world);
    const DwaSettings with = settings(numbers);
    const Aim to = aim(numbers, at);
    const Needed needed = needed_gaps(at, with);
    const std::vector<geometry::Twist2> wanted = speed_window(at, with);
    const std::vector<plain::Rollout> expected = plain::roll_out(at, needed, wanted, to, with);
    const std::vector<SampleBlock> found = batched::roll_out(at, needed, wanted, to, with);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const SampleBlock& block = found[i / kBlock];
      ASSERT_EQ(block.moves[i % kBlock], expected[i].moves);
      ASSERT_EQ(block.collisions[i % kBlock], expected[i].collision) << "round " << round << " sample " << i;
      ++met[static_cast<int>(expected[i].collision)];
      if (expected[i].moves && expected[i].collision == Obstruction::kWall) continue;
      ASSERT_EQ(bits_of(block.at(i % kBlock)), bits_of(expected[i].sample)) << "round " << round << " sample " << i;
      near_walls += expected[i].sample.wall_gap_m < to.wall_cap_m ? 1 : 0;
    }
  }
  for (int kind = 0; kind < 3; ++kind) EXPECT_GT(met[kind], 20) << "of kind " << kind;
  EXPECT_EQ(met[static_cast<int>(Obstruction::kPeer)], 0) << "where they will be is the traffic's business";
  EXPECT_GT(near_walls, 100);
}

TEST_P(AnyScene, ChoosesTheSameSample) {
  Numbers numbers{std::mt19937_64(3)};
  int chosen = 0;
  for (int round = 0; round < kScenes; ++round) {
    const World world(numbers);
    const Scene at = scene(numbers, world);
    const DwaSettings with = settings(numbers);
    const Aim to = aim(numbers, at);
    for (const Variant& variant : all_variants()) {
      const Choice expected = plain::choose(at, to, variant, with), found = batched::choose(at, to, variant, with);
      ASSERT_EQ(found.found, expected.found);
      ASSERT_EQ(found.twist.linear_mps, expected.twist.linear_mps) << variant.name << " round " << round;
      ASSERT_EQ(found.twist.angular_radps, expected.twist.angular_radps) << variant.name << " round " << round;
      ASSERT_EQ(found.twist.sideways_mps, expected.twist.sideways_mps) << variant.name << " round " << round;
      ASSERT_EQ(found.wall_gap_m, expected.wall_gap_m);
      ASSERT_EQ(found.mover_gap_m, expected.mover_gap_m);
      ASSERT_EQ(found.moving, expected.moving);
      ASSERT_EQ(found.rejected, expected.rejected);
      chosen += expected.found ? 1 : 0;
    }
  }
  EXPECT_GT(chosen, 100);
}

INSTANTIATE_TEST_SUITE_P(AnyVehicle, AnyScene,
                         ::testing::Combine(::testing::Values(kinematics::Model::kDifferential,
                                                              kinematics::Model::kOmnidirectional,
                                                              kinematics::Model::kTricycle),
                                            ::testing::Bool()));

}  // namespace
}  // namespace aisle::local_planner
