// The least gap of each sample is that of all its discs at all steps.
#include "services/local-planner/core/walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "common/geometry/footprint.hpp"
#include "tests/unit/local-planner/hall.hpp"
#include "tests/unit/local-planner/some_twists.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Twist2;

/// The gap of sample i, when every disc is looked up.
double gap_m(const Scene& scene, const ArcBlock& arcs, std::size_t i) {
  const Arc<geometry::Batch>& arc = arcs.batches[i / geometry::kBatch];
  const std::size_t k = i % geometry::kBatch;
  const Point2 base{arc.x[k], arc.y[k]}, heading{arc.cos_yaw()[k], arc.sin_yaw()[k]};
  double least_m = 1e9;
  for (const double ahead_m : scene.discs_ahead_m)
    least_m = std::min(least_m, scene.clearance.clearance_m(base + ahead_m * heading) - scene.radius_m);
  return least_m;
}

/// A rectangle's discs and a disc, far from walls and beside them: each least gap is that of its own nearest disc, or
/// known to be enough.
TEST(WallGaps, KnowsTheLeastGapOfEachSample) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> at(1.0, 11.0);
  grid::OccupancyGrid grid = hall(12.0, 12.0);
  for (int i = 0; i < 10; ++i) {
    const double x = at(random), y = at(random);
    block(grid, x, y, x + 0.5, y + 0.5);
  }
  const grid::ClearanceField clearance(grid);
  const std::vector<Mover> movers;
  const std::vector<PeerMotion> peers;
  constexpr double kEnoughM = 0.2;
  int near = 0, equal = 0;
  for (int round = 0; round < 300; ++round) {
    const geometry::CoveringDiscs discs =
        geometry::covering_discs(round % 2 == 0 ? geometry::disc(0.35) : geometry::rectangle(2.4, 1.1, 0.4));
    const Scene scene{
        clearance,    {at(random), at(random), 0.01 * round}, {}, discs.radius_m, {}, 1.2, movers, peers, 0.0,
        discs.ahead_m};
    const std::vector<Twist2> twists = some_twists(random, round % 3 == 0 ? 3 : kBlock);
    const TwistBlock all(twists.data(), twists.size());
    ArcBlock arcs(scene.base_in_map);
    arcs.set_steps(all, 0.1);
    PerSample way_m, expected_m;
    find_driven_m(all, swing_m(scene), 0.1, way_m);
    expected_m.fill(kEnoughM);
    const Outlines outlines(scene, arcs);
    WallGaps walls(outlines, wall_gaps_m(scene), kEnoughM);
    std::size_t left = kBlock;  // this one's gap is not computed any more
    for (int step = 0; step < 20; ++step) {
      arcs.step();
      const bool is_near = walls.look(way_m);
      bool is_expected = false;
      for (std::size_t i = 0; i < kBlock; ++i) {
        if (i == left) continue;
        const double now_m = gap_m(scene, arcs, i);
        is_expected = is_expected || now_m < kEnoughM;
        expected_m[i] = std::min(expected_m[i], now_m);
        constexpr double kInterpolationM = 0.23 * 0.05;  // what it knew a moment ago is a lower bound as well
        ASSERT_NEAR(walls.least_m()[i], expected_m[i], kInterpolationM) << "round " << round;
        ASSERT_GE(walls.least_m()[i], expected_m[i]) << "round " << round;
        if (expected_m[i] == kEnoughM) continue;
        ++near;
        equal += walls.least_m()[i] == expected_m[i] ? 1 : 0;
      }
      ASSERT_TRUE(is_expected || !is_near) << "round " << round;
      if (step == 10) walls.leave(left = static_cast<std::size_t>(round) % kBlock);
    }
  }
  EXPECT_GT(near, 10000);
  EXPECT_GT(equal, near - near / 1000);
}

}  // namespace
}  // namespace aisle::local_planner
