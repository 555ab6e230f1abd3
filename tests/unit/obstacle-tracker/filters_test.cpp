// What every filter must do, and what each says of its own motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/config/yaml_reader.hpp"
#include "services/obstacle-tracker/core/motion_filter.hpp"
#include "services/obstacle-tracker/core/motions/straight.hpp"
#include "services/obstacle-tracker/core/motions/turning.hpp"
#include "services/obstacle-tracker/core/tracker.hpp"

namespace aisle::obstacle_tracker {
namespace {

using State = Eigen::Matrix<double, 5, 1>;  // x, y, vx, vy, turn rate

constexpr double kPeriod_s = 0.1;
constexpr double kMeasured_m = 0.03;
const Eigen::Matrix2d kMeasured = Eigen::Matrix2d::Identity() * kMeasured_m * kMeasured_m;

MotionModel motion_of(const std::string& filter) {
  MotionModel motion;
  motion.filter = filter;
  return motion;
}

/// Draws from normal distributions.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : random_(seed) {}
  double draw(double sigma) { return sigma * normal_(random_); }
  Eigen::Vector4d draw(const Eigen::Matrix4d& covariance) {
    const Eigen::Vector4d unit(draw(1.0), draw(1.0), draw(1.0), draw(1.0));
    return covariance.llt().matrixL() * unit;
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

/// Filters the way with noisy positions and hands (truth, filter) to `judge` after every one of them.
template <class Judge>
void follow(const MotionModel& motion, const std::vector<State>& way, Chance& chance, const Judge& judge) {
  const auto seen = [&](const State& s) {
    return Eigen::Vector2d(s(0) + chance.draw(kMeasured_m), s(1) + chance.draw(kMeasured_m));
  };
  const auto filter = make_filter(motion, seen(way.front()), kMeasured);
  for (std::size_t k = 1; k < way.size(); ++k) {
    filter->predict(kPeriod_s);
    filter->update(seen(way[k]), kMeasured, 0.0);
    judge(k, way[k], *filter);
  }
}

std::vector<State> circle(double speed_mps, double turn_radps, int steps) {
  State state;
  state << 1.0, -2.0, speed_mps, 0.0, turn_radps;
  std::vector<State> way{state};
  for (int k = 0; k < steps; ++k) way.push_back(on_circle(way.back(), kPeriod_s));
  return way;
}

/// Root mean square of the velocity's error from the second second on.
double velocity_rms(const std::string& filter, const std::vector<State>& way) {
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Chance chance(seed);
    follow(motion_of(filter), way, chance, [&](std::size_t k, const State& truth, const MotionFilter& belief) {
      if (k < 10) return;
      sum += (belief.state().tail<2>() - truth.segment<2>(2)).squaredNorm();
      ++count;
    });
  }
  return std::sqrt(sum / count);
}

class EveryFilter : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Filters, EveryFilter, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const Filter& filter : all_filters()) names.push_back(filter.name);
                           return names;
                         }()),
                         [](const auto& of) {
                           std::string name = of.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(EveryFilter, FollowsAStraightWalk) { EXPECT_LT(velocity_rms(GetParam(), circle(1.3, 0.0, 60)), 0.2); }

TEST_P(EveryFilter, ComparesALateMeasurementWithWhereTheThingThenWas) {
  const auto filter = make_filter(motion_of(GetParam()), {0.0, 0.0}, kMeasured);
  for (int k = 1; k <= 40; ++k) {
    filter->predict(kPeriod_s);
    filter->update({1.3 * kPeriod_s * k, 0.0}, kMeasured, 0.0);
  }
  EXPECT_NEAR(filter->innovation({1.3 * (4.0 - 0.08), 0.0}, kMeasured, 0.08).residual.x(), 0.0, 0.02);
  const double before = filter->state().x();
  filter->update({1.3 * (4.0 - 0.08), 0.0}, kMeasured, 0.08);
  EXPECT_NEAR(filter->state().x(), before, 0.02);
}

TEST_P(EveryFilter, StaysWhereItIsToldToStand) {
  const auto filter = make_filter(motion_of(GetParam()), {2.0, 3.0}, kMeasured);
  for (int k = 0; k < 20; ++k) filter->predict(kPeriod_s), filter->update({2.0, 3.0}, kMeasured, 0.0);
  for (int k = 0; k < 300; ++k) filter->stand(kPeriod_s);
  EXPECT_LT((filter->state() - Eigen::Vector4d(2.0, 3.0, 0.0, 0.0)).norm(), 0.05);
  EXPECT_LT(std::sqrt(filter->covariance()(0, 0)), 0.1);
}

TEST_P(EveryFilter, TakesDoubtIntoTheVelocity) {
  const auto filter = make_filter(motion_of(GetParam()), {0.0, 0.0}, kMeasured);
  for (int k = 1; k <= 30; ++k) filter->predict(kPeriod_s), filter->update({1.3 * kPeriod_s * k, 0.0}, kMeasured, 0.0);
  const double before = filter->covariance()(2, 2);
  filter->loosen(0.5);
  EXPECT_NEAR(filter->covariance()(2, 2), before + 0.25, 0.05);
}

TEST(Filters, RefuseANameThatIsNone) {
  EXPECT_THROW(make_filter(motion_of("clairvoyant"), {0.0, 0.0}, kMeasured), std::invalid_argument);
  TrackerParams params;
  try {
    config::read_yaml_text("motion:\n  filter: constant-spin\n", "tracker.yaml", params);
    FAIL() << "taken";
  } catch (const config::BadInput& bad) {
    EXPECT_NE(std::string(bad.what()).find("tracker.yaml:2"), std::string::npos) << bad.what();
    EXPECT_NE(std::string(bad.what()).find("constant-turn"), std::string::npos) << bad.what();
  }
}

TEST(ConstantTurn, FollowsACircleBetterThanAStraightLineDoes) {
  const std::vector<State> way = circle(1.3, 0.8, 80);
  EXPECT_LT(velocity_rms("constant-turn", way), 0.8 * velocity_rms("constant-velocity", way));
}

TEST(InteractingMix, IsNotMuchWorseThanTheBestOfItsMotions) {
  const std::vector<State> turning = circle(1.3, 0.8, 80);
  EXPECT_LT(velocity_rms("interacting-mix", turning), velocity_rms("constant-velocity", turning));
  const std::vector<State> standing = circle(0.0, 0.0, 80);
  EXPECT_LT(velocity_rms("interacting-mix", standing), 0.6 * velocity_rms("constant-velocity", standing));
}

TEST(Turning, KnowsAQuarterOfACircle) {
  State state;
  state << 0.0, 0.0, 1.0, 0.0, 0.5;  // radius 2 m
  State quarter;
  quarter << 2.0, 2.0, 0.0, 1.0, 0.5;
  EXPECT_LT((on_circle(state, geometry::kPi) - quarter).norm(), 1e-12);
}

TEST(Turning, HasTheJacobianOfItsMotion) {
  for (const double turn_radps : {0.0, 1e-6, -2e-3, 0.0099, 0.0101, 0.7, -3.0}) {
    State state;
    state << 0.3, -1.2, 1.1, -0.7, turn_radps;
    const Eigen::Matrix<double, 5, 5> jacobian = jacobian_of_circle(state, kPeriod_s);
    for (int column = 0; column < 5; ++column) {
      constexpr double kStep = 1e-5;
      State up = state;
      State down = state;
      up(column) += kStep;
      down(column) -= kStep;
      const State slope = (on_circle(up, kPeriod_s) - on_circle(down, kPeriod_s)) / (2.0 * kStep);
      EXPECT_LT((slope - jacobian.col(column)).norm(), 1e-8) << "turn rate " << turn_radps << ", column " << column;
    }
  }
}

// Consistency: Bar-Shalom, Li, Kirubarajan 2001, 5.4.2. The normalised estimation error squared, over many runs of a
// truth that moves as the filter says, must have the mean of a chi-square with as many degrees of freedom.

constexpr int kRuns = 200;
constexpr int kSteps = 40;

/// Mean of each step over the runs: of the place, of the velocity, of both.
struct Nees {
  std::array<std::array<double, kSteps>, 3> mean{};
};

double nees_of(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
  return error.dot(covariance.inverse() * error);
}

template <class WayOf>
Nees nees_over_runs(const MotionModel& motion, const WayOf& way_of) {
  Nees nees;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    Chance chance(seed);
    follow(motion, way_of(chance), chance, [&](std::size_t k, const State& truth, const MotionFilter& belief) {
      const Eigen::Vector4d error = belief.state() - truth.head<4>();
      const Eigen::Matrix4d& p = belief.covariance();
      nees.mean[0][k - 1] += nees_of(error.head<2>(), p.topLeftCorner<2, 2>()) / kRuns;
      nees.mean[1][k - 1] += nees_of(error.tail<2>(), p.bottomRightCorner<2, 2>()) / kRuns;
      nees.mean[2][k - 1] += nees_of(error, p) / kRuns;
    });
  }
  return nees;
}

double mean_of(const std::array<double, kSteps>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value / kSteps;
  return sum;
}

/// A 95 % bound of the mean of kRuns chi-square variables with n degrees of freedom (Wilson, Hilferty 1931).
double bound_of_mean(int n, double sigmas) {
  const double freedom = static_cast<double>(n) * kRuns;
  return freedom * std::pow(1.0 - 2.0 / (9.0 * freedom) + sigmas * std::sqrt(2.0 / (9.0 * freedom)), 3) / kRuns;
}

/// Within the bounds at nine steps of ten, and on average.
bool is_consistent(const std::array<double, kSteps>& means, int n) {
  const double low = bound_of_mean(n, -1.96);
  const double high = bound_of_mean(n, 1.96);
  const auto inside =
      std::count_if(means.begin(), means.end(), [&](double mean) { return mean >= low && mean <= high; });
  return inside * 10 >= kSteps * 9 && mean_of(means) >= low && mean_of(means) <= high;
}

/// A way that moves exactly as constant-velocity says.
std::vector<State> straight_way(const MotionModel& motion, Chance& chance) {
  State state = State::Zero();
  state(2) = chance.draw(motion.first_speed_sigma_mps);
  state(3) = chance.draw(motion.first_speed_sigma_mps);
  const Eigen::Matrix4d noise = acceleration_noise(motion.acceleration_density, kPeriod_s);
  std::vector<State> way{state};
  for (int k = 0; k < kSteps; ++k) {
    state.head<2>() += kPeriod_s * state.segment<2>(2);
    state.head<4>() += chance.draw(noise);
    way.push_back(state);
  }
  return way;
}

TEST(Consistency, ConstantVelocityIsWithinItsChiSquareBounds) {
  const MotionModel motion = motion_of("constant-velocity");
  const Nees nees = nees_over_runs(motion, [&](Chance& chance) { return straight_way(motion, chance); });
  EXPECT_TRUE(is_consistent(nees.mean[0], 2)) << "place " << mean_of(nees.mean[0]);
  EXPECT_TRUE(is_consistent(nees.mean[1], 2)) << "velocity " << mean_of(nees.mean[1]);
  EXPECT_TRUE(is_consistent(nees.mean[2], 4)) << "both " << mean_of(nees.mean[2]);
}

TEST(Consistency, IsLostWhenTheNoiseIsWrongByAFactor) {
  const MotionModel truth = motion_of("constant-velocity");
  for (const double factor : {1.0 / 3.0, 0.5, 2.0, 3.0}) {
    MotionModel wrong = truth;
    wrong.acceleration_density *= factor;
    const Nees nees = nees_over_runs(wrong, [&](Chance& chance) { return straight_way(truth, chance); });
    EXPECT_FALSE(is_consistent(nees.mean[1], 2)) << factor;
    EXPECT_FALSE(is_consistent(nees.mean[2], 4)) << factor;
  }
}

TEST(Consistency, ConstantTurnIsNearlyHonestOfItsOwnMotion) {
  const MotionModel motion = motion_of("constant-turn");
  const Nees nees = nees_over_runs(motion, [&](Chance& chance) {
    State state = State::Zero();
    state(2) = chance.draw(motion.first_speed_sigma_mps);
    state(3) = chance.draw(motion.first_speed_sigma_mps);
    state(kTurnRate) = chance.draw(motion.first_turn_sigma_radps);
    const Eigen::Matrix4d noise = acceleration_noise(motion.acceleration_density, kPeriod_s);
    std::vector<State> way{state};
    for (int k = 0; k < kSteps; ++k) {
      state = on_circle(state, kPeriod_s);
      state.head<4>() += chance.draw(noise);
      state(kTurnRate) += chance.draw(std::sqrt(motion.turn_density * kPeriod_s));
      way.push_back(state);
    }
    return way;
  });
  EXPECT_NEAR(mean_of(nees.mean[0]), 2.0, 0.3);
  EXPECT_NEAR(mean_of(nees.mean[1]), 2.0, 0.3);
}

TEST(Consistency, TheMixIsNotTooSureOfAStraightWalkNorOfAStandingThing) {
  const MotionModel motion = motion_of("interacting-mix");
  const Nees walking = nees_over_runs(motion, [&](Chance& chance) { return straight_way(motion, chance); });
  EXPECT_LT(mean_of(walking.mean[0]), 2.6);
  EXPECT_LT(mean_of(walking.mean[1]), 2.6);
  const Nees standing = nees_over_runs(motion, [&](Chance&) { return std::vector<State>(kSteps + 1, State::Zero()); });
  EXPECT_LT(mean_of(standing.mean[0]), 2.3);
  EXPECT_LT(mean_of(standing.mean[1]), 2.3);
}

}  // namespace
}  // namespace aisle::obstacle_tracker
