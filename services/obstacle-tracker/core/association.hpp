#pragma once

#include <vector>

namespace aisle::obstacle_tracker {

/// A track (row) and a detection (column) that may be matched. Pairs that are not listed may not.
struct Candidate {
  int row{0};
  int column{0};
  double cost{0.0};  // less than the cost of leaving both unmatched
};

/// The matching of rows to columns with the least total cost, where an unmatched row costs `alone` and an unmatched
/// column nothing.
///
/// How: rows and columns are divided into components that no candidate links, and each is solved by shortest augmenting
/// paths (Jonker, Volgenant, "A Shortest Augmenting Path Algorithm for Dense and Sparse Linear Assignment Problems",
/// Computing 38, 1987) in O(n^3): the time grows with the largest crowd, not with the site.
/// @param candidates each with 0 <= row < rows and 0 <= column < columns
/// @return for each row its column, or -1
std::vector<int> assign(int rows, int columns, const std::vector<Candidate>& candidates, double alone);

}  // namespace aisle::obstacle_tracker
