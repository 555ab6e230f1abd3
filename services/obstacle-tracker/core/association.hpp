#pragma once
#include <vector>

namespace aisle::obstacle_tracker {

/// A track (row) and a detection (column) that may be matched. Pairs that are not listed may not.
struct Candidate {
  int row{0};
  int column{0};
  double cost{0.0};  // less than the cost of leaving both unmatched
};

/// For each row its column, or -1: the matching with the least total cost, where an unmatched row costs `alone`.
///
/// How: rows and columns are divided into components that no candidate links, and each is solved by shortest augmenting
/// paths (Jonker, Volgenant 1987) in O(n^3): the time grows with the largest crowd, not with the site.
std::vector<int> assign(int rows, int columns, const std::vector<Candidate>& candidates, double alone);

}  // namespace aisle::obstacle_tracker
