// Commands at 50 Hz over a link that loses, delays, repeats and reorders them: what the vehicle makes of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include "common/fleet/command_authority.hpp"
#include "services/fake-vehicle/core/simulated_vehicle.hpp"

namespace aisle::fake_vehicle {
namespace {

using std::chrono::milliseconds;

struct Link {
  double loss;
  double repeated;
  int most_delay_ms;
};

struct Figures {
  int stops{0};
  std::vector<std::uint64_t> applied;  // sequence numbers, in order of application
  std::uint64_t refused{0};
  time::Stamp longest_gap{};
};

/// A command every 20 ms for `seconds`, through the link, to a vehicle in an endless hall.
Figures drive(const Link& link, int seconds) {
  const grid::OccupancyGrid floor(grid::Geometry{10, 10, 1000.0, {-5000.0, -5000.0}});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  fleet::CommandAuthority authority("agv-1", 0);
  SimulatedVehicle vehicle(Parameters{}, {0.0, 0.0, 0.0});
  std::multimap<time::Stamp, std::uint64_t> on_the_way;
  Figures figures;
  time::Stamp last{};
  Hold before = Hold::kNoCommand;
  const time::Stamp start = std::chrono::seconds(10);
  for (int ms = 0; ms < 1000 * seconds; ms += 5) {
    const time::Stamp now = start + milliseconds(ms);
    if (ms % 20 == 0) {
      const std::uint64_t sequence = static_cast<std::uint64_t>(ms / 20 + 1);
      for (int copies = unit(random) < link.repeated ? 2 : 1; copies > 0; --copies)
        if (unit(random) >= link.loss)
          on_the_way.emplace(now + milliseconds(static_cast<int>(unit(random) * link.most_delay_ms)), sequence);
    }
    for (auto next = on_the_way.begin(); next != on_the_way.end() && next->first <= now;
         next = on_the_way.erase(next)) {
      fleet::VelocityCommand command;
      command.agv_id = "agv-1";
      command.twist = {0.5, 0.0, 0.0};
      const fleet::Origin by{"local-planner-agv-1", 0, 1, next->second, 0};
      if (authority.judge(command, by) != fleet::CommandVerdict::kAccepted) continue;
      if (last != time::Stamp{}) figures.longest_gap = std::max(figures.longest_gap, now - last);
      last = now;
      figures.applied.push_back(next->second);
      vehicle.command(command.twist, now);
    }
    vehicle.advance_to(now, {floor, {}});
    if (vehicle.hold() == Hold::kLateCommand && before != Hold::kLateCommand) ++figures.stops;
    before = vehicle.hold();
  }
  figures.refused = authority.refused();
  return figures;
}

TEST(LossyLink, ATenthOfTheCommandsLostStopsNobodyInTenMinutes) {
  const Figures figures = drive({0.10, 0.0, 0}, 600);
  EXPECT_EQ(figures.stops, 0);
  EXPECT_LE(figures.longest_gap, milliseconds(120));
}

TEST(LossyLink, AFifthOfThemNeither) {
  const Figures figures = drive({0.20, 0.0, 0}, 600);
  EXPECT_EQ(figures.stops, 0);
  EXPECT_LE(figures.longest_gap, milliseconds(200));
}

TEST(LossyLink, WhatComesTwiceOrOvertakenIsAppliedOnceAndInOrder) {
  const Figures figures = drive({0.05, 0.2, 150}, 60);
  EXPECT_GT(figures.refused, 500U);
  EXPECT_GT(figures.applied.size(), 500U);
  EXPECT_EQ(std::adjacent_find(figures.applied.begin(), figures.applied.end(), std::greater_equal<>()),
            figures.applied.end());
  EXPECT_EQ(figures.stops, 0);
}

}  // namespace
}  // namespace aisle::fake_vehicle
