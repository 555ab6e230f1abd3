#include "services/global-planner/core/traffic/corridors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace aisle::global_planner::traffic {
namespace {

using Neighbours = std::vector<std::vector<std::uint32_t>>;

/// How many nodes can be reached from `from`, without a node and without an edge.
std::size_t reached(const Neighbours& graph, std::uint32_t from, std::uint32_t without,
                    std::pair<std::uint32_t, std::uint32_t> cut) {
  std::set<std::uint32_t> seen{from};
  std::vector<std::uint32_t> open{from};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    for (const std::uint32_t next : graph[at]) {
      const bool is_cut = std::minmax(at, next) == std::minmax(cut.first, cut.second);
      if (next != without && !is_cut && seen.insert(next).second) open.push_back(next);
    }
  }
  return seen.size();
}

TEST(Cuts, AreThoseFoundByTakingAwayEachNodeAndEdge) {
  std::mt19937 random(4);
  for (int round = 0; round < 200; ++round) {
    const std::uint32_t count = 2 + static_cast<std::uint32_t>(random() % 12);
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (unsigned i = 0; i < count + random() % 4; ++i) {
      const auto a = static_cast<std::uint32_t>(random() % count);
      const auto b = static_cast<std::uint32_t>(random() % count);
      if (a != b) edges.insert(std::minmax(a, b));
    }
    Neighbours graph(count);
    for (const auto& [a, b] : edges) {
      graph[a].push_back(b);
      graph[b].push_back(a);
    }

    const Cuts cuts = find_cuts(graph);
    constexpr std::uint32_t kNobody = Cuts::kNone;
    for (std::uint32_t node = 0; node < count; ++node) {
      bool is_cut = false;
      std::size_t bridges = 0;
      for (const std::uint32_t next : graph[node]) {
        const std::size_t whole = reached(graph, next, kNobody, {kNobody, kNobody});
        is_cut = is_cut || reached(graph, next, node, {kNobody, kNobody}) + 1 < whole;
        bridges += reached(graph, next, kNobody, {node, next}) < whole ? 1 : 0;
      }
      ASSERT_EQ(cuts.is_cut[node], is_cut);
      ASSERT_EQ(cuts.corridor[node] != Cuts::kNone, !graph[node].empty() && bridges == graph[node].size());
    }
    for (const auto& [a, b] : edges) {
      const bool are_both_inside = cuts.corridor[a] != Cuts::kNone && cuts.corridor[b] != Cuts::kNone;
      ASSERT_TRUE(!are_both_inside || cuts.corridor[a] == cuts.corridor[b]);
    }
  }
}

TEST(Cuts, OfAChainOfAHundredThousandNeedNoDeepStack) {
  Neighbours chain(100'000);
  for (std::uint32_t i = 1; i < chain.size(); ++i) {
    chain[i - 1].push_back(i);
    chain[i].push_back(i - 1);
  }
  const Cuts cuts = find_cuts(chain);
  EXPECT_FALSE(cuts.is_cut.front());
  EXPECT_TRUE(cuts.is_cut[50'000]);
  EXPECT_EQ(cuts.corridor.back(), 0U);
}

}  // namespace
}  // namespace aisle::global_planner::traffic
