#include "tools/lab/traffic_bounds/configuration_search.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <numeric>

#include "tools/lab/traffic_bounds/pibt_step.hpp"

namespace aisle::lab {
namespace {

using Configuration = std::vector<Vertex>;

/// Moves prescribed to the first vehicles of a node's order.
struct Constraint {
  std::shared_ptr<const Constraint> before;
  Vertex to{kNoVertex};
  std::size_t depth{0};  // so many vehicles are prescribed a move
};

struct Node {
  Configuration at;
  std::size_t parent{0};
  std::vector<std::uint64_t> waited;  // of each vehicle: steps since it last was at its goal
  std::vector<std::size_t> order;     // vehicles, the highest priority first
  std::deque<std::shared_ptr<const Constraint>> open;
};

class Search {
 public:
  Search(const StepGraph& graph, const std::vector<StepTable>& to_go, std::uint64_t seed)
      : graph_(graph), tables_(to_go), pibt_(graph, seed) {
    for (const StepTable& table : to_go) to_go_.push_back(&table);
  }

  std::optional<std::vector<Configuration>> run(const Configuration& starts, std::size_t most_tries) {
    std::vector<std::size_t> stack{add(starts, 0)};

    for (std::size_t tries = 0; !stack.empty() && tries < most_tries; ++tries) {
      const std::size_t number = stack.back();
      if (is_end(nodes_[number].at)) return way_to(number);
      if (nodes_[number].open.empty()) {
        stack.pop_back();
        continue;
      }

      const std::shared_ptr<const Constraint> constraint = nodes_[number].open.front();
      nodes_[number].open.pop_front();
      open_further(number, constraint);

      if (const std::optional<Configuration> next = step(number, constraint)) stack.push_back(add(*next, number));
    }

    return std::nullopt;
  }

 private:
  bool is_end(const Configuration& at) const {
    for (std::size_t i = 0; i < at.size(); ++i)
      if (tables_[i][at[i]] != 0) return false;
    return true;
  }

  /// The node of this configuration; a known one is taken up again.
  std::size_t add(const Configuration& at, std::size_t parent) {
    const auto [known, is_new] = known_.try_emplace(at, nodes_.size());
    if (!is_new) return known->second;

    Node node;
    node.at = at;
    node.parent = parent;
    node.open.push_back(std::make_shared<const Constraint>());
    node.waited.assign(at.size(), 0);
    if (!nodes_.empty())
      for (std::size_t i = 0; i < at.size(); ++i)
        node.waited[i] = tables_[i][at[i]] == 0 ? 0 : nodes_[parent].waited[i] + 1;

    node.order.resize(at.size());
    std::iota(node.order.begin(), node.order.end(), std::size_t{0});
    std::stable_sort(node.order.begin(), node.order.end(), [&](std::size_t a, std::size_t b) {
      if (node.waited[a] != node.waited[b]) return node.waited[a] > node.waited[b];
      return tables_[a][at[a]] > tables_[b][at[b]];
    });

    nodes_.push_back(std::move(node));
    return nodes_.size() - 1;
  }

  /// The constraints that prescribe one move more than this one.
  void open_further(std::size_t number, const std::shared_ptr<const Constraint>& constraint) {
    Node& node = nodes_[number];
    if (constraint->depth >= node.at.size()) return;

    const Vertex here = node.at[node.order[constraint->depth]];
    const auto add_move = [&](Vertex to) {
      node.open.push_back(std::make_shared<const Constraint>(Constraint{constraint, to, constraint->depth + 1}));
    };

    for (const Vertex to : graph_.neighbours[here]) add_move(to);
    add_move(here);
  }

  std::optional<Configuration> step(std::size_t number, const std::shared_ptr<const Constraint>& constraint) {
    const Node& node = nodes_[number];
    Configuration next(node.at.size(), kNoVertex);
    for (const Constraint* c = constraint.get(); c->depth > 0; c = c->before.get())
      next[node.order[c->depth - 1]] = c->to;

    if (!pibt_.plan(node.at, node.order, to_go_, next)) return std::nullopt;
    return next;
  }

  std::vector<Configuration> way_to(std::size_t number) const {
    std::vector<Configuration> way{nodes_[number].at};
    for (; number != 0; number = nodes_[number].parent) way.push_back(nodes_[nodes_[number].parent].at);
    std::reverse(way.begin(), way.end());
    return way;
  }

  const StepGraph& graph_;
  const std::vector<StepTable>& tables_;
  std::vector<const StepTable*> to_go_;
  PibtStep pibt_;
  std::vector<Node> nodes_;
  std::map<Configuration, std::size_t> known_;
};

}  // namespace

std::optional<std::vector<std::vector<Vertex>>> find_configurations(const StepGraph& graph,
                                                                    const std::vector<Vertex>& starts,
                                                                    const std::vector<StepTable>& to_go,
                                                                    std::uint64_t seed,
                                                                    std::size_t most_configurations) {
  return Search(graph, to_go, seed).run(starts, most_configurations);
}

}  // namespace aisle::lab
