#include "services/global-planner/core/traffic/lock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <random>
#include <set>

#include "tests/unit/global-planner/traffic/random_shape.hpp"

namespace aisle::global_planner::traffic {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kGapM = 0.05;

Shape disc(double x, double y = 0.0) { return Shape({{{x, y}, {x, y}, 0.45}}); }

TEST(Lock, AdmitsWhatMeetsNobody) {
  Lock lock(kGapM);
  EXPECT_TRUE(lock.admit("agv-1", 0, disc(0.0)));
  EXPECT_TRUE(lock.admit("agv-2", 0, disc(1.0)));
  EXPECT_FALSE(lock.admit("agv-3", 0, disc(0.5)));
  EXPECT_THAT(lock.holders("agv-3", disc(0.5)), ElementsAre("agv-1", "agv-2"));
  EXPECT_THAT(lock.held("agv-3"), IsEmpty());
}

TEST(Lock, OwnShapesMayMeet) {
  Lock lock(kGapM);
  EXPECT_TRUE(lock.admit("agv-1", 0, disc(0.0)));
  EXPECT_TRUE(lock.admit("agv-1", 1, disc(0.2)));
}

TEST(Lock, HoldsUntilReleasedByALaterStep) {
  Lock lock(kGapM);
  lock.admit("agv-1", 0, disc(0.0));
  lock.admit("agv-1", 1, disc(1.0));
  lock.release("agv-1", 1);
  EXPECT_TRUE(lock.admit("agv-2", 0, disc(-0.1)));
  EXPECT_FALSE(lock.admit("agv-2", 1, disc(1.0)));
  lock.release("agv-1", 0);  // an old report
  EXPECT_FALSE(lock.admit("agv-2", 1, disc(1.0)));
}

TEST(Lock, AStepAdmittedTwiceHoldsBoth) {
  Lock lock(kGapM);
  lock.admit("agv-1", 3, disc(0.0));
  lock.admit("agv-1", 3, disc(5.0));
  EXPECT_FALSE(lock.admit("agv-2", 0, disc(0.0)));
  EXPECT_FALSE(lock.admit("agv-2", 0, disc(5.0)));
  lock.release("agv-1", 4);
  EXPECT_TRUE(lock.admit("agv-2", 0, disc(0.0)));
  EXPECT_TRUE(lock.admit("agv-2", 0, disc(5.0)));
}

TEST(Lock, GivesBackFromAStepOn) {
  Lock lock(kGapM);
  for (std::uint64_t step = 0; step < 4; ++step) lock.admit("agv-1", step, disc(static_cast<double>(step)));
  lock.give_back("agv-1", 2);
  EXPECT_TRUE(lock.holders("agv-2", disc(3.0)).empty());
  EXPECT_FALSE(lock.holders("agv-2", disc(1.0)).empty());
}

TEST(Lock, AForcedShapeIsHeldWhateverItMeetsAndReplacesTheEarlier) {
  Lock lock(kGapM);
  lock.admit("agv-1", 0, disc(0.0));
  lock.force("agv-2", disc(0.1));
  EXPECT_FALSE(lock.admit("agv-1", 1, disc(0.2)));
  lock.release("agv-2", 100);
  lock.give_back("agv-2", 0);
  EXPECT_EQ(lock.held("agv-2").count(Lock::kForced), 1U);
  lock.force("agv-2", disc(9.0));
  EXPECT_TRUE(lock.admit("agv-1", 1, disc(0.2)));
  EXPECT_FALSE(lock.admit("agv-1", 2, disc(9.0)));
  lock.force("agv-2", Shape());
  EXPECT_TRUE(lock.admit("agv-1", 2, disc(9.0)));
}

TEST(Lock, AnExceptedPairDoesNotCountAgainstEachOtherUntilItEnds) {
  Lock lock(kGapM);
  lock.force("agv-1", disc(0.0));
  lock.force("agv-2", disc(0.6));
  lock.except("agv-2", "agv-1");
  EXPECT_TRUE(lock.admit("agv-1", 0, disc(-0.1)));
  EXPECT_FALSE(lock.admit("agv-3", 0, disc(-0.1)));
  lock.end_exception("agv-1", "agv-2");
  EXPECT_FALSE(lock.admit("agv-1", 1, disc(-0.1)));
}

TEST(Lock, KeepsAPartOfWhatItHoldsWhateverIsForcedUponIt) {
  Lock lock(kGapM);
  lock.admit("agv-1", 3, Shape({{{0.0, 0.0}, {2.0, 0.0}, 0.45}}));
  lock.force("agv-2", disc(2.0));
  EXPECT_FALSE(lock.admit("agv-1", 4, disc(2.0)));
  EXPECT_TRUE(lock.keep("agv-1", 4, disc(2.0)));
  lock.release("agv-1", 4);
  EXPECT_THAT(lock.holders("agv-3", disc(2.0)), ElementsAre("agv-1", "agv-2"));
  EXPECT_THAT(lock.holders("agv-3", disc(0.5)), IsEmpty());
}

TEST(Lock, KeepsNothingThatReachesBeyondWhatWasAdmitted) {
  Lock lock(kGapM);
  lock.admit("agv-1", 3, Shape({{{0.0, 0.0}, {2.0, 0.0}, 0.45}}));
  lock.force("agv-1", disc(9.0));
  EXPECT_FALSE(lock.keep("agv-1", 4, disc(2.01)));
  EXPECT_FALSE(lock.keep("agv-1", 4, Shape({{{1.0, 0.0}, {1.0, 0.0}, 0.46}})));
  EXPECT_FALSE(lock.keep("agv-1", 4, disc(9.0))) << "forced, not admitted";
  EXPECT_FALSE(lock.keep("agv-2", 4, disc(1.0))) << "another one's";
  EXPECT_EQ(lock.held("agv-1").count(4), 0U);
}

TEST(Lock, ForgetsAVehicle) {
  Lock lock(kGapM);
  lock.admit("agv-1", 0, disc(0.0));
  lock.force("agv-1", disc(3.0));
  lock.except("agv-1", "agv-2");
  lock.forget("agv-1");
  EXPECT_TRUE(lock.admit("agv-2", 0, disc(0.0)));
  EXPECT_TRUE(lock.admit("agv-2", 1, disc(3.0)));
  EXPECT_FALSE(lock.admit("agv-1", 0, disc(0.0)));
}

/// What the lock must hold, kept beside it and looked through one by one.
class Model {
 public:
  std::map<std::string, std::map<std::uint64_t, Shape>> held;
  std::set<std::pair<std::string, std::string>> excepted;

  bool is_excepted(const std::string& a, const std::string& b) const {
    return excepted.count({a, b}) + excepted.count({b, a}) > 0;
  }

  std::vector<std::string> holders(const std::string& id, const Shape& shape) const {
    std::vector<std::string> out;
    for (const auto& [other, steps] : held) {
      if (other == id || is_excepted(id, other)) continue;
      for (const auto& [step, of_other] : steps) {
        if (gap_between_m(shape, of_other) >= kGapM - 1e-9) continue;
        out.push_back(other);
        break;
      }
    }
    return out;
  }
};

/// Looks at points of the shape, one by one: does the vehicle hold them all, forced shapes aside?
bool holds_points_of(const std::map<std::uint64_t, Shape>& held, const Shape& shape) {
  for (const Capsule& capsule : shape.capsules()) {
    for (int i = 0; i <= 4; ++i) {
      for (int direction = 0; direction < 8; ++direction) {
        const double angle = 0.25 * geometry::kPi * direction;
        const geometry::Point2 at = capsule.from_in_map + 0.25 * i * (capsule.to_in_map - capsule.from_in_map) +
                                    capsule.radius_m * geometry::Point2{std::cos(angle), std::sin(angle)};
        bool is_held = false;
        for (const auto& [step, of_step] : held) {
          if (step != Lock::kForced) is_held = is_held || gap_between_m(of_step, Shape({{at, at, 0.0}})) < 1e-9;
        }
        if (!is_held) return false;
      }
    }
  }
  return true;
}

/// A part of one of the vehicle's shapes, or a little more than a part; empty: it holds none.
Shape part_of_held(std::mt19937& random, const std::map<std::uint64_t, Shape>& held) {
  if (held.empty()) return {};

  const Shape& whole = std::next(held.begin(), static_cast<std::ptrdiff_t>(random() % held.size()))->second;
  Capsule part = whole.capsules()[random() % whole.capsules().size()];
  if (random() % 2 == 0) part.to_in_map = 0.5 * (part.from_in_map + part.to_in_map);
  part.radius_m *= 0.8 + 0.1 * static_cast<double>(random() % 4);
  return Shape({part});
}

// 100,000 random admissions, releases, exceptions, kept parts and forced shapes against the model: the same answers,
// the same holders, and never two admitted shapes that meet.
TEST(Lock, NeverLetsTwoHoldOneFloor) {
  std::mt19937 random(15);
  Lock lock(kGapM);
  Model model;
  std::map<std::string, std::uint64_t> next;
  int admitted = 0;
  int refused = 0;
  int kept = 0;

  const auto drop = [&](const std::string& id, std::uint64_t from, std::uint64_t to) {
    auto& steps = model.held[id];
    steps.erase(steps.lower_bound(from), steps.lower_bound(to));
  };

  for (int i = 0; i < 100'000; ++i) {
    const std::string id = "agv-" + std::to_string(random() % 12);
    const std::string other = "agv-" + std::to_string(random() % 12);
    const unsigned what = random() % 110;

    if (what >= 100) {
      const Shape part = part_of_held(random, model.held[id]);
      const bool is_held = lock.keep(id, next[id], part);
      if (is_held) {
        ASSERT_TRUE(holds_points_of(model.held[id], part));
        if (!part.empty()) model.held[id][next[id]++].add(part);
        ++kept;
      }
    } else if (what < 60) {
      const Shape shape = random_shape(random, 16.0);
      const auto holders = model.holders(id, shape);
      ASSERT_EQ(lock.holders(id, shape), holders);
      ASSERT_EQ(lock.admit(id, next[id], shape), holders.empty());
      if (holders.empty()) model.held[id][next[id]++].add(shape);
      ++(holders.empty() ? admitted : refused);
    } else if (what < 85) {
      const std::uint64_t step = next[id] - std::min<std::uint64_t>(next[id], random() % 4);
      lock.release(id, step);
      drop(id, 0, step);
    } else if (what < 92) {
      const std::uint64_t step = next[id] - std::min<std::uint64_t>(next[id], random() % 3);
      lock.give_back(id, step);
      drop(id, step, Lock::kForced);
    } else if (what < 94) {
      lock.force(id, random() % 2 == 0 ? Shape() : random_shape(random, 16.0));
      model.held[id].erase(Lock::kForced);
      const auto forced = lock.held(id).find(Lock::kForced);
      if (forced != lock.held(id).end()) model.held[id][Lock::kForced] = forced->second;
    } else if (what < 95 && id != other) {
      lock.except(id, other);
      model.excepted.insert({id, other});
    } else if (what < 99) {
      lock.end_exception(id, other);
      model.excepted.erase({id, other});
      model.excepted.erase({other, id});
    } else {
      lock.forget(id);
      model.held.erase(id);
      for (auto pair = model.excepted.begin(); pair != model.excepted.end();)
        pair = pair->first == id || pair->second == id ? model.excepted.erase(pair) : std::next(pair);
    }

    ASSERT_EQ(lock.held(id).size(), model.held[id].size());
  }

  EXPECT_GT(admitted, 10'000);
  EXPECT_GT(refused, 10'000);
  EXPECT_GT(kept, 1'000);
}

// Without forced shapes and exceptions: whatever the order of admissions and releases, no two holders meet.
TEST(Lock, HoldersNeverMeet) {
  std::mt19937 random(16);
  Lock lock(kGapM);
  std::vector<std::string> ids;
  for (int i = 0; i < 8; ++i) ids.push_back("agv-" + std::to_string(i));

  for (std::uint64_t step = 0; step < 2'000; ++step) {
    const std::string& id = ids[random() % ids.size()];
    lock.admit(id, step, random_shape(random, 10.0));
    if (step % 3 == 0) lock.keep(id, step, part_of_held(random, lock.held(id)));
    lock.release(ids[random() % ids.size()], step > 20 ? step - 20 : 0);
    if (step % 20 != 0) continue;

    for (std::size_t a = 0; a < ids.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        for (const auto& of_a : lock.held(ids[a]))
          for (const auto& of_b : lock.held(ids[b])) ASSERT_GE(gap_between_m(of_a.second, of_b.second), kGapM - 1e-9);
  }
}

}  // namespace
}  // namespace aisle::global_planner::traffic
