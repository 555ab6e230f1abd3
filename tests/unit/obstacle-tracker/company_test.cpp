// People who stop beside each other are two, whatever one scan can show of them; two tracks of one thing are one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "services/obstacle-tracker/core/tracker.hpp"
#include "tests/unit/obstacle-tracker/stage.hpp"

namespace aisle::obstacle_tracker::test {
namespace {

constexpr double kStop_s = 2.0;

const std::vector<Vehicle> kOneVehicle{{"a", {8.0, 2.0, 0.7}, {}, 0.35, 10.0, 360}};
const std::vector<Vehicle> kTwoVehicles{{"a", {8.0, 2.0, 0.7}, {}, 0.35, 10.0, 360},
                                        {"b", {6.5, 2.5, 0.0}, {}, 0.35, 10.0, 360}};

/// Of the second after two stopped: in how many moments there is not one track at each of them; and how often one has
/// another id than while they came.
struct Company {
  int moments{0};
  int not_two{0};
  int other_ids{0};
};

std::uint64_t id_at(const Stage& stage, std::size_t disc) {
  const Track* track = stage.track_at(stage.world.discs[disc].center_in_map, 0.3);
  return track != nullptr ? track->id : 0;
}

/// `where(leg_m)`: the two people this far before they stop, at 1.2 m/s.
Company stop_together(const std::vector<Vehicle>& fleet, const std::function<std::vector<Disc>(double)>& where) {
  constexpr double kComing_s = 1.5;
  Company company;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Stage stage(room(16.0, 12.0), fleet, seed);
    const auto arrange = [&](double t) { stage.world.discs = where(1.2 * std::max(0.0, kStop_s - t)); };
    stage.run(kComing_s, arrange);
    const std::uint64_t first = id_at(stage, 0);
    const std::uint64_t second = id_at(stage, 1);
    stage.run(kStop_s, arrange);
    stage.run(kStop_s + 1.0, arrange, [&](double) {
      const bool are_two = id_at(stage, 0) != 0 && id_at(stage, 1) != 0 && id_at(stage, 0) != id_at(stage, 1);
      ++company.moments;
      company.not_two += are_two ? 0 : 1;
    });
    company.other_ids += (id_at(stage, 0) == first ? 0 : 1) + (id_at(stage, 1) == second ? 0 : 1);
  }
  return company;
}

const Point2 kMiddle{8.0, 6.0};

std::vector<Disc> towards_each_other(double leg_m, double gap_m) {
  return {{{kMiddle.x - 0.5 * gap_m - leg_m, kMiddle.y}, 0.25}, {{kMiddle.x + 0.5 * gap_m + leg_m, kMiddle.y}, 0.25}};
}

std::vector<Disc> up_to_one_who_stands(double leg_m, double gap_m) {
  return {{{kMiddle.x - 0.5 * gap_m, kMiddle.y}, 0.25}, {{kMiddle.x + 0.5 * gap_m + leg_m, kMiddle.y}, 0.25}};
}

TEST(Company, TwoWhoStopSideBySideAreNotMergedAndKeepTheirIds) {
  for (const std::vector<Vehicle>& fleet : {kOneVehicle, kTwoVehicles}) {
    for (const double gap_m : {0.5, 0.55, 0.6}) {
      const Company company = stop_together(fleet, [&](double leg_m) { return towards_each_other(leg_m, gap_m); });
      EXPECT_LE(20 * company.not_two, company.moments)
          << fleet.size() << " vehicles, " << gap_m << " m apart: " << company.not_two;
      EXPECT_LE(company.other_ids, 1) << fleet.size() << " vehicles, " << gap_m << " m apart";
    }
  }
}

TEST(Company, WhoStopsBesideOneWhoStandsIsNotMergedIntoHim) {
  for (const std::vector<Vehicle>& fleet : {kOneVehicle, kTwoVehicles}) {
    Company all;
    for (const double gap_m : {0.5, 0.55, 0.6}) {
      const Company company = stop_together(fleet, [&](double leg_m) { return up_to_one_who_stands(leg_m, gap_m); });
      all.moments += company.moments;
      all.not_two += company.not_two;
      all.other_ids += company.other_ids;
    }
    EXPECT_LE(5 * all.not_two, all.moments) << fleet.size() << " vehicles: " << all.not_two;
    EXPECT_LE(all.other_ids, 7) << fleet.size() << " vehicles";
  }
}

/// They brush past each other, one of them hardly seen for a moment.
TEST(Company, TwoWhoBrushPastEachOtherStayTwo) {
  for (const std::vector<Vehicle>& fleet : {kOneVehicle, kTwoVehicles}) {
    int lost = 0;
    for (unsigned seed = 1; seed <= 16; ++seed) {
      Stage stage(room(16.0, 12.0), fleet, seed);
      const auto pass = [&](double t) {
        stage.world.discs = {{{5.0 + 1.2 * t, 6.0}, 0.25}, {{11.0 - 1.2 * t, 6.25}, 0.25}};
      };
      stage.run(2.0, pass);
      const std::set<std::uint64_t> before{id_at(stage, 0), id_at(stage, 1)};
      stage.run(3.2, pass);
      const std::set<std::uint64_t> after{id_at(stage, 0), id_at(stage, 1)};
      ASSERT_EQ(before.size(), 2U);
      if (after != before) ++lost;
    }
    EXPECT_LE(lost, 2) << fleet.size() << " vehicles";
  }
}

/// One walks up from behind another who stands, and is hidden by them when near. The walker is still expected to come
/// out: their tracks are not one.
TEST(Company, AWalkerHiddenByOneWhoStandsIsStillExpected) {
  constexpr double kStands_s = 4.0;  // then the walker is seen
  constexpr double kSpeed_mps = 0.8;
  constexpr double kBehind_m = 2.5;
  const std::vector<Vehicle> aslant{{"a", {7.3, 3.5, 0.7}, {}, 0.35, 10.0, 360}};

  int moments = 0;
  int expected = 0;
  for (unsigned seed = 1; seed <= 16; ++seed) {
    Stage stage(room(16.0, 12.0), aslant, seed);
    const auto arrange = [&](double t) {
      const double behind_m = kBehind_m - kSpeed_mps * (t - kStands_s);
      stage.world.discs = {{kMiddle, 0.25}};
      if (t >= kStands_s) stage.world.discs.push_back({{kMiddle.x, kMiddle.y + behind_m}, 0.25});
    };
    const auto is_walker = [](const Track& track) { return !track.is_static && track.velocity_in_map.y < -0.5; };

    // From when the tracks are near enough to be taken for one until the walker is where the other stands.
    const double near_s = kStands_s + (kBehind_m - Lifecycle{}.merge_m) / kSpeed_mps;
    stage.run(kStands_s + kBehind_m / kSpeed_mps, arrange, [&](double t) {
      if (t < near_s) return;
      ++moments;
      expected += std::any_of(stage.tracks.begin(), stage.tracks.end(), is_walker) ? 1 : 0;
    });
  }

  ASSERT_GT(moments, 0) << "nothing was looked at";
  EXPECT_GE(10 * expected, 8 * moments) << expected << " of " << moments;
}

int pairs_within(const std::vector<Track>& tracks, double within_m) {
  int pairs = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    for (std::size_t j = i + 1; j < tracks.size(); ++j) {
      if (geometry::distance(tracks[i].position_in_map, tracks[j].position_in_map) < within_m) ++pairs;
    }
  }
  return pairs;
}

/// Two vehicles see a thin wall from its two sides, each its own face of it.
TEST(Company, DoublesOfOneThingAreMerged) {
  for (const double length_m : {1.6, 2.2, 3.0}) {
    int doubles = 0;
    int moments = 0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
      Stage stage(room(16.0, 12.0), {kOneVehicle[0], {"b", {8.0, 10.0, 0.0}, {}, 0.35, 10.0, 360}}, seed);
      stage.world.boxes = {{{kMiddle.x, kMiddle.y, 0.1 * seed}, length_m, 0.15}};
      stage.run(1.0, [](double) {});
      stage.run(
          3.0, [](double) {},
          [&](double) {
            ++moments;
            doubles += pairs_within(stage.tracks, Lifecycle{}.merge_m);
          });
    }
    EXPECT_LE(10 * doubles, moments) << length_m << " m long: " << doubles;
  }
}

}  // namespace
}  // namespace aisle::obstacle_tracker::test
