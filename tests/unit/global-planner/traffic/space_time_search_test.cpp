#include "services/global-planner/core/traffic/space_time_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <vector>

#include "tests/unit/global-planner/traffic/plan_world.hpp"

namespace aisle::global_planner::traffic {
namespace {

using test_support::Dice;
using test_support::PlanWorld;

constexpr double kGapM = 0.05;

const std::vector<std::string> kRoom{
    "###########", "#.........#", "#.........#", "#...##....#",
    "#...##....#", "#.........#", "#.........#", "###########",
};

/// A shape taken for a time.
struct Taken {
  Shape shape;
  double from_s{0.0};
  double to_s{0.0};
};

/// The search by hand: all ways that never wait longer than they must, without any dominance between them.
class ByHand {
 public:
  ByHand(const Roadmap& roadmap, const std::vector<Taken>& taken) : roadmap_(roadmap), taken_(taken) {}

  /// When the goal is reached at the soonest.
  /// @param most_s later arrivals are not looked for
  std::optional<double> soonest_s(PlaceId start, PlaceId goal, double most_s) {
    std::priority_queue<State, std::vector<State>, Later> open;
    std::set<std::tuple<PlaceId, MotionId, long>> known;
    open.push({0.0, start, 0.0, kNoId, true});
    while (!open.empty()) {
      const State state = open.top();
      open.pop();
      if (state.time_s > most_s) return std::nullopt;
      if (!known.insert({state.place, state.by, std::lround(state.time_s * 1e6)}).second) continue;
      if (state.place == goal && is_free(roadmap_.place(goal).standing, state.time_s, kForEver)) return state.time_s;

      for (const MotionId id : roadmap_.place(state.place).leaving) {
        for (const double departure_s : departures(state.time_s)) {
          if (!is_free(roadmap_.place(state.place).standing, state.time_s, departure_s)) break;
          if (const auto next = driven(state, id, departure_s)) open.push(*next);
        }
      }
    }
    return std::nullopt;
  }

 private:
  struct State {
    double time_s{0.0};
    PlaceId place{kNoId};
    double heading_rad{0.0};
    MotionId by{kNoId};
    bool is_standing{false};
  };
  struct Later {
    bool operator()(const State& a, const State& b) const { return a.time_s > b.time_s; }
  };

  /// At once, or when something that is taken gets free.
  std::vector<double> departures(double from_s) const {
    std::set<double> out{from_s};
    for (const Taken& taken : taken_)
      if (taken.to_s > from_s && taken.to_s < kForEver) out.insert(taken.to_s);
    return {out.begin(), out.end()};
  }

  bool is_free(const Shape& shape, double from_s, double to_s) const {
    for (const Taken& taken : taken_)
      if (taken.from_s < to_s - 1e-9 && from_s < taken.to_s - 1e-9 && meet(taken.shape, shape, kGapM)) return false;
    return true;
  }

  std::optional<State> driven(const State& state, MotionId id, double departure_s) const {
    const Motion& motion = roadmap_.motion(id);
    const Kind& kind = roadmap_.kind(motion.kind);
    const bool waits = departure_s > state.time_s;
    const double run = run_s(kind, motion, state.heading_rad, state.is_standing || waits);
    if (!is_free(motion.shape, departure_s, departure_s + run)) return std::nullopt;
    if (state.by != kNoId) {
      const auto& way_in = roadmap_.motion(state.by).path_in_map;
      const Shape corner = corner_shape(kind, way_in[way_in.size() - 2], way_in.back(), motion.path_in_map[1]);
      if (!corner.empty() && !is_free(corner, departure_s, departure_s + run)) return std::nullopt;
    }
    return State{departure_s + run, motion.to, motion.exit_rad, id, false};
  }

  const Roadmap& roadmap_;
  const std::vector<Taken>& taken_;
};

class RandomReservations : public ::testing::TestWithParam<int> {};

TEST_P(RandomReservations, TheSearchFindsWhatASearchByHandFinds) {
  PlanWorld world(kRoom);
  Dice dice(static_cast<std::uint64_t>(GetParam()) + 3);
  const Roadmap& roadmap = world.roadmap();
  const auto places = world.places();
  ASSERT_GE(places.size(), 6U);

  Meetings meetings(roadmap, kGapM);
  Reservations reservations(meetings, 0.0);
  std::vector<Taken> taken;
  const PlaceId start = places[dice.below(places.size())];
  for (int i = 0; i < 5; ++i) {
    const auto& leaving = roadmap.place(places[dice.below(places.size())]).leaving;
    if (leaving.empty()) continue;
    const MotionId motion = leaving[dice.below(leaving.size())];
    const double from_s = dice.between(0.5, 8.0);
    const double to_s = i == 0 ? kForEver : from_s + dice.between(0.5, 5.0);
    reservations.add({1, 0, Reservation::Use::kStep, meetings.of_motion(motion), from_s, to_s});
    taken.push_back({roadmap.motion(motion).shape, from_s, to_s});
  }

  SpaceTimeSearch search(world.roadmap(), meetings, reservations, {40'000, 0.0, 1.0});
  View view;
  view.agent = 0;
  for (int i = 0; i < 3; ++i) {
    const PlaceId goal = places[dice.below(places.size())];
    const auto legs = search.find({world.kind(), start, 0.0, 0.0, true, kNoId}, {goal, {}}, view);
    const auto by_hand_s = ByHand(roadmap, taken).soonest_s(start, goal, 25.0);

    ASSERT_EQ(legs.has_value(), by_hand_s.has_value());
    if (!legs) continue;
    const double end_s = legs->empty() ? 0.0 : legs->back().end_s;
    EXPECT_GE(end_s, *by_hand_s - 1e-6) << "no way can be that fast";
    EXPECT_LE(end_s, *by_hand_s + 1.0) << "of two arrivals the earlier is kept, though one that waited starts slower";
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomReservations, ::testing::Range(0, 40));

TEST(SpaceTimeSearch, TakenTimesLessThanTheMergeTimeApartAreOne) {
  Intervals intervals{{5.0, 6.0}, {1.0, 2.0}, {2.2, 3.0}};
  Reservations::merge(intervals, 0.3);

  ASSERT_EQ(intervals.size(), 2U);
  EXPECT_DOUBLE_EQ(intervals[0].from_s, 1.0);
  EXPECT_DOUBLE_EQ(intervals[0].to_s, 3.0);
}

TEST(SpaceTimeSearch, ARestCountsForEverOrForAWhile) {
  Reservation rest{1, 4, Reservation::Use::kRest, 0, 10.0, kForEver};
  View view;
  view.agent = 2;
  view.now_s = 12.0;
  EXPECT_DOUBLE_EQ(Reservations::counted(rest, view).to_s, kForEver);

  view.soft_rest_s = 6.0;
  EXPECT_DOUBLE_EQ(Reservations::counted(rest, view).to_s, 18.0);

  rest.is_frozen = true;
  EXPECT_DOUBLE_EQ(Reservations::counted(rest, view).to_s, kForEver);

  view.agent = 1;
  EXPECT_LE(Reservations::counted(rest, view).to_s, Reservations::counted(rest, view).from_s) << "its own";
}

}  // namespace
}  // namespace aisle::global_planner::traffic
