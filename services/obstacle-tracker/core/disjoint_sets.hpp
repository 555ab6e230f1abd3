#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace aisle::obstacle_tracker {

/// Which of the things 0..n-1 belong together: union-find with path halving (Tarjan, van Leeuwen, "Worst-case analysis
/// of set union algorithms", 1984), O(log n) a call on average over a sequence of calls.
class DisjointSets {
 public:
  /// At first each thing is a set of its own.
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  /// The thing that stands for the set of `i`, the same for all things of the set until the set is joined to another.
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }

    return i;
  }

  /// Makes one set of the two; the root of `b` becomes its root.
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace aisle::obstacle_tracker
