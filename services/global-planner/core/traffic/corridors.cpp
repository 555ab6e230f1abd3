#include "services/global-planner/core/traffic/corridors.hpp"

#include <algorithm>

namespace aisle::global_planner::traffic {
namespace {

using Neighbours = std::vector<std::vector<std::uint32_t>>;

/// The walk: `order` is when a node was met, `low` the earliest that it or those after it reach by an edge back. The
/// edge down to a node is a bridge when nothing after it reaches above that edge.
class Walk {
 public:
  explicit Walk(const Neighbours& neighbours)
      : neighbours_(neighbours),
        order_(neighbours.size(), 0),
        low_(neighbours.size(), 0),
        bridges_(neighbours.size(), 0) {
    cuts_.is_cut.assign(neighbours.size(), false);
    cuts_.corridor.assign(neighbours.size(), Cuts::kNone);
  }

  Cuts run() {
    for (std::uint32_t root = 0; root < neighbours_.size(); ++root)
      if (order_[root] == 0) walk_from(root);

    number_corridors();
    return cuts_;
  }

 private:
  struct Level {
    std::uint32_t node;
    std::uint32_t parent;
    std::size_t next;  // of its neighbours
  };

  void walk_from(std::uint32_t root) {
    std::vector<Level> stack;
    std::size_t from_root = 0;
    enter(root, Cuts::kNone, stack);

    while (!stack.empty()) {
      const std::uint32_t node = stack.back().node;
      const std::uint32_t parent = stack.back().parent;

      if (stack.back().next < neighbours_[node].size()) {
        const std::uint32_t next = neighbours_[node][stack.back().next++];
        if (next == parent) continue;
        if (order_[next] != 0) {
          low_[node] = std::min(low_[node], order_[next]);
        } else {
          enter(next, node, stack);
        }
        continue;
      }

      stack.pop_back();
      if (parent != Cuts::kNone) leave(node, parent, root, from_root);
    }

    cuts_.is_cut[root] = from_root > 1;
  }

  void enter(std::uint32_t node, std::uint32_t parent, std::vector<Level>& stack) {
    order_[node] = low_[node] = ++met_;
    stack.push_back({node, parent, 0});
  }

  void leave(std::uint32_t node, std::uint32_t parent, std::uint32_t root, std::size_t& from_root) {
    low_[parent] = std::min(low_[parent], low_[node]);
    if (parent == root) ++from_root;
    if (parent != root && low_[node] >= order_[parent]) cuts_.is_cut[parent] = true;

    if (low_[node] > order_[parent]) {
      ++bridges_[node];
      ++bridges_[parent];
    }
  }

  bool is_in_corridor(std::uint32_t node) const {
    return !neighbours_[node].empty() && bridges_[node] == neighbours_[node].size();
  }

  void number_corridors() {
    std::uint32_t count = 0;
    for (std::uint32_t first = 0; first < neighbours_.size(); ++first) {
      if (!is_in_corridor(first) || cuts_.corridor[first] != Cuts::kNone) continue;

      std::vector<std::uint32_t> open{first};
      cuts_.corridor[first] = count;
      while (!open.empty()) {
        const std::uint32_t node = open.back();
        open.pop_back();
        for (const std::uint32_t next : neighbours_[node]) {
          if (!is_in_corridor(next) || cuts_.corridor[next] != Cuts::kNone) continue;
          cuts_.corridor[next] = count;
          open.push_back(next);
        }
      }
      ++count;
    }
  }

  const Neighbours& neighbours_;
  std::vector<std::uint32_t> order_;  // from 1 on; 0: not met
  std::vector<std::uint32_t> low_;
  std::vector<std::size_t> bridges_;  // edges of the node that are bridges
  std::uint32_t met_{0};
  Cuts cuts_;
};

}  // namespace

Cuts find_cuts(const std::vector<std::vector<std::uint32_t>>& neighbours) { return Walk(neighbours).run(); }

}  // namespace aisle::global_planner::traffic
