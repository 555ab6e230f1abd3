#pragma once
#include <vector>

namespace aisle::obstacle_tracker {

/// A pair that may belong together. Pairs that are not listed may not.
struct Candidate {
  int row{0};
  int column{0};
  double cost{0.0};  // less than the cost of leaving both alone
};

/// For each row its column, or -1: the set of pairs with the least total cost, where a row left alone costs `alone`.
/// Rows and columns that no candidate links are solved apart, so the time grows with the largest crowd, not with the
/// site. Shortest augmenting paths (Jonker, Volgenant 1987), O(n^3) a crowd.
std::vector<int> assign(int rows, int columns, const std::vector<Candidate>& candidates, double alone);

}  // namespace aisle::obstacle_tracker
