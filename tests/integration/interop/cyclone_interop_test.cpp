// Cyclone DDS, with types made from our IDL, finds our writers and decodes their samples.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace aisle {
namespace {

using namespace std::chrono_literals;
using test_support::ChildProcess;
using testing::HasSubstr;

std::vector<std::string> subscriber(const std::string& domain, const std::string& partition,
                                    const std::string& seconds) {
  return {test_support::test_program("aisle_cyclone_subscriber"),
          "--domain",
          domain,
          "--partition",
          partition,
          "--interface",
          "127.0.0.1",
          "--seconds",
          seconds};
}

TEST(Cyclone, DecodesASiteInAPartition) {
  const ChildProcess site({test_support::test_program("bus_test_peer"), "220", "site-a", "planner-1", "site"});
  ChildProcess cyclone(subscriber("220", "site-a", "20"));
  EXPECT_EQ(cyclone.wait(30s), 0) << cyclone.err();
  EXPECT_THAT(
      cyclone.out(),
      HasSubstr(R"({"topic": "map_info", "map_id": "site", "revision": 7, "width_cells": 64, "height_cells": 64, )"
                R"("resolution_m": 0.05, "tile_hashes": 1, "first_hash": 42})"));
  EXPECT_THAT(
      cyclone.out(),
      HasSubstr(
          R"({"topic": "map_tile", "map_id": "site", "tile_x": 0, "tile_y": 0, "hash": 42, "cells": 4096, "occupied": 4096})"));
  EXPECT_THAT(
      cyclone.out(),
      HasSubstr(
          R"({"topic": "vehicle_info", "agv_id": "planner-1", "model": 2, "footprint": 1, "length_m": 2.4, "ahead_m": 0.4, )"
          R"("steers_behind": 1, "wheelbase_m": 1.5, "max_steering_rate_radps": 0.8})"));
  EXPECT_THAT(cyclone.out(), HasSubstr(R"({"topic": "vehicle_state", "agv_id": "planner-1", "x_m": 1.25, )"));
  EXPECT_THAT(cyclone.out(), HasSubstr(R"("sideways_mps": 0.25, "steering_rad": -0.5})"));
  EXPECT_THAT(cyclone.out(), HasSubstr(R"("source_id": "planner-1")"));
  EXPECT_THAT(cyclone.out(), HasSubstr(R"("waypoints": 2, "last_x_m": 2.5})"));
  EXPECT_THAT(
      cyclone.out(),
      HasSubstr(
          R"({"topic": "coverage", "source_id": "planner-1", "tile_x": 1, "tile_y": 2, "cell_m": 0.25, "cells": 12, "unseen": 12})"));
}

TEST(Cyclone, HearsNothingOfAnotherPartition) {
  const ChildProcess site({test_support::test_program("bus_test_peer"), "221", "site-a", "planner-1", "site"});
  ChildProcess cyclone(subscriber("221", "site-b", "2"));
  EXPECT_EQ(cyclone.wait(10s), 1);
  EXPECT_EQ(cyclone.out(), "");
}

}  // namespace
}  // namespace aisle
