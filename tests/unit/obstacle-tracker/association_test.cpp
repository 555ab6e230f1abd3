#include "services/obstacle-tracker/core/association.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace aisle::obstacle_tracker::test {
namespace {

double cost_of(const std::vector<int>& column_of_row, const std::vector<Candidate>& candidates, double alone) {
  double total = 0.0;
  for (std::size_t row = 0; row < column_of_row.size(); ++row) {
    const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
      return c.row == static_cast<int>(row) && c.column == column_of_row[row];
    });
    total += found != candidates.end() ? found->cost : alone;
  }
  return total;
}

/// Tries everything.
double least_cost(int row, int rows, std::vector<char>& taken, const std::vector<Candidate>& candidates, double alone) {
  if (row == rows) return 0.0;
  double best = alone + least_cost(row + 1, rows, taken, candidates, alone);
  for (const Candidate& c : candidates) {
    if (c.row != row || taken[static_cast<std::size_t>(c.column)]) continue;
    taken[static_cast<std::size_t>(c.column)] = 1;
    best = std::min(best, c.cost + least_cost(row + 1, rows, taken, candidates, alone));
    taken[static_cast<std::size_t>(c.column)] = 0;
  }
  return best;
}

TEST(Association, PrefersTheWholeToTheNearest) {
  // The nearest pair first would leave row 1 alone.
  EXPECT_EQ(assign(2, 2, {{0, 0, 1.0}, {0, 1, 2.0}, {1, 0, 1.5}}, 10.0), (std::vector<int>{1, 0}));
}

TEST(Association, LeavesAloneWhatHasNoCandidate) {
  EXPECT_EQ(assign(3, 1, {{1, 0, 1.0}}, 10.0), (std::vector<int>{-1, 0, -1}));
}

TEST(Association, IsAsCheapAsTryingEverything) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> size(0, 6);
  std::uniform_real_distribution<double> uniform(-5.0, 12.0);
  for (int round = 0; round < 500; ++round) {
    const int rows = size(random);
    const int columns = size(random);
    std::vector<Candidate> candidates;
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        if (random() % 3 != 0) candidates.push_back({r, c, uniform(random)});
      }
    }
    const std::vector<int> assigned = assign(rows, columns, candidates, 9.0);
    std::vector<int> used;
    for (const int column : assigned) {
      if (column >= 0) used.push_back(column);
    }
    std::sort(used.begin(), used.end());
    EXPECT_EQ(std::adjacent_find(used.begin(), used.end()), used.end()) << "round " << round;
    std::vector<char> taken(static_cast<std::size_t>(columns), 0);
    EXPECT_NEAR(cost_of(assigned, candidates, 9.0), least_cost(0, rows, taken, candidates, 9.0), 1e-9)
        << "round " << round;
  }
}

}  // namespace
}  // namespace aisle::obstacle_tracker::test
