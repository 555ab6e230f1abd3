#include "tools/lab/traffic_bounds/one_shot_plan.hpp"

#include <algorithm>
#include <queue>
#include <random>
#include <unordered_map>
#include <utility>

#include "tools/lab/traffic_bounds/configuration_search.hpp"

namespace aisle::lab {
namespace {

constexpr std::size_t kMostMembers = 8;
constexpr std::size_t kMostExpanded = 20'000;  // of one vehicle's search
constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

using Path = std::vector<Vertex>;  // a vertex a step, until it is at its goal for good

/// Which vehicle is where at which step. A vehicle stays at the end of its path for ever.
class Occupation {
 public:
  Occupation(std::size_t vertices, std::size_t steps)
      : vertices_(vertices), steps_(steps), at_(vertices * steps, kNobody) {}

  std::size_t steps() const { return steps_; }

  std::uint32_t at(std::size_t step, Vertex vertex) const {
    return at_[std::min(step, steps_ - 1) * vertices_ + vertex];
  }

  void put(std::uint32_t vehicle, const Path& path) { write(path, vehicle); }
  void take(const Path& path) { write(path, kNobody); }

  /// The first step from which on nobody comes to the vertex any more; steps(): somebody stays there.
  std::size_t free_from(Vertex vertex) const {
    std::size_t step = steps_;
    while (step > 0 && at_[(step - 1) * vertices_ + vertex] == kNobody) --step;
    return step;
  }

 private:
  void write(const Path& path, std::uint32_t vehicle) {
    for (std::size_t step = 0; step < steps_; ++step)
      at_[step * vertices_ + path[std::min(step, path.size() - 1)]] = vehicle;
  }

  std::size_t vertices_;
  std::size_t steps_;
  std::vector<std::uint32_t> at_;
};

/// The soonest way to the goal between all others: A* in space and time. Empty: none within the budget.
Path soonest_path(const StepGraph& graph, const Occupation& others, Vertex start, const StepTable& to_go, Vertex goal) {
  struct Open {
    std::uint32_t end;   // step at which it is at the goal at the soonest
    std::uint32_t step;  // later ones first: nearer to the goal
    Vertex vertex;
    bool operator<(const Open& other) const {
      if (end != other.end) return end > other.end;
      if (step != other.step) return step < other.step;
      return vertex > other.vertex;
    }
  };

  const std::size_t last = others.free_from(goal);
  if (last >= others.steps()) return {};

  const auto key = [&](std::uint32_t step, Vertex v) { return std::uint64_t{step} * graph.size() + v; };
  std::priority_queue<Open> open;
  std::unordered_map<std::uint64_t, Vertex> came_from{{key(0, start), kNoVertex}};
  open.push({to_go[start], 0, start});

  for (std::size_t expanded = 0; !open.empty() && expanded < kMostExpanded; ++expanded) {
    const Open now = open.top();
    open.pop();

    if (now.vertex == goal && now.step >= last) {
      Path path;
      Vertex v = goal;
      for (std::uint32_t step = now.step; v != kNoVertex; --step) {
        path.push_back(v);
        v = came_from.at(key(step, v));
      }
      std::reverse(path.begin(), path.end());
      return path;
    }

    if (now.step + 1 >= others.steps()) continue;

    const auto try_vertex = [&](Vertex to) {
      if (to_go[to] == kNoWay || others.at(now.step + 1, to) != kNobody) return;
      const std::uint32_t met = others.at(now.step, to);
      if (to != now.vertex && met != kNobody && others.at(now.step + 1, now.vertex) == met) return;  // they would swap
      if (!came_from.emplace(key(now.step + 1, to), now.vertex).second) return;
      open.push({std::max(now.step + 1 + to_go[to], static_cast<std::uint32_t>(last)), now.step + 1, to});
    };

    for (const Vertex to : graph.neighbours[now.vertex]) try_vertex(to);
    try_vertex(now.vertex);
  }

  return {};
}

/// Shortens the paths of a few vehicles at a time.
class Improvement {
 public:
  Improvement(const StepGraph& graph, const std::vector<Vertex>& goals, const std::vector<StepTable>& to_go,
              std::vector<Path>& paths, std::uint64_t seed)
      : graph_(graph), goals_(goals), to_go_(to_go), paths_(paths), random_(seed), others_(graph.size(), room(paths)) {
    for (std::size_t i = 0; i < paths.size(); ++i) others_.put(static_cast<std::uint32_t>(i), paths[i]);
  }

  void round() {
    const std::size_t seed = one_that_loses();
    if (lost(seed) == 0) return;

    std::vector<std::size_t> members = around(seed);
    for (std::size_t i = members.size(); i > 1; --i) std::swap(members[i - 1], members[random_() % i]);
    replan(members);
  }

 private:
  /// Steps that are looked at: half as many again as the first plan has.
  static std::size_t room(const std::vector<Path>& paths) {
    std::size_t longest = 0;
    for (const Path& path : paths) longest = std::max(longest, path.size());
    return longest + longest / 2 + 16;
  }

  std::size_t lost(std::size_t i) const { return paths_[i].size() - 1 - to_go_[i][paths_[i].front()]; }

  /// Of three drawn, the one that loses most.
  std::size_t one_that_loses() {
    std::size_t best = random_() % paths_.size();
    for (int draw = 0; draw < 2; ++draw) {
      const std::size_t other = random_() % paths_.size();
      if (lost(other) > lost(best)) best = other;
    }
    return best;
  }

  /// The vehicle, those that stand in its shortest way as it would pass, and others by chance.
  std::vector<std::size_t> around(std::size_t seed) {
    std::vector<std::size_t> members{seed};
    const auto add = [&](std::uint32_t vehicle) {
      if (vehicle == kNobody || members.size() >= kMostMembers) return;
      if (std::find(members.begin(), members.end(), vehicle) == members.end()) members.push_back(vehicle);
    };

    Vertex v = paths_[seed].front();
    for (std::size_t step = 0; to_go_[seed][v] > 0; ++step) {
      const std::vector<Vertex>& all = graph_.neighbours[v];
      const std::size_t first = random_() % all.size();
      for (std::size_t i = 0; i < all.size(); ++i) {
        const Vertex to = all[(first + i) % all.size()];
        if (to_go_[seed][to] + 1 != to_go_[seed][v]) continue;
        v = to;
        break;
      }

      add(others_.at(step, v));
      add(others_.at(step + 1, v));
    }

    add(others_.at(others_.steps(), goals_[seed]));
    for (std::size_t draw = 0; draw < kMostMembers / 2; ++draw)
      add(static_cast<std::uint32_t>(random_() % paths_.size()));
    return members;
  }

  /// One after the other between all others; all as before where the sum of costs would rise.
  void replan(const std::vector<std::size_t>& members) {
    std::vector<Path> before;
    std::size_t cost_before = 0, cost = 0;
    for (const std::size_t i : members) {
      before.push_back(paths_[i]);
      cost_before += paths_[i].size() - 1;
      others_.take(paths_[i]);
    }

    std::size_t planned = 0;
    for (; planned < members.size(); ++planned) {
      const std::size_t i = members[planned];
      Path path = soonest_path(graph_, others_, before[planned].front(), to_go_[i], goals_[i]);
      cost += path.empty() ? 0 : path.size() - 1;
      if (path.empty() || cost > cost_before) break;

      others_.put(static_cast<std::uint32_t>(i), path);
      paths_[i] = std::move(path);
    }

    if (planned == members.size()) return;
    for (std::size_t k = 0; k < planned; ++k) others_.take(paths_[members[k]]);
    for (std::size_t k = 0; k < members.size(); ++k) {
      paths_[members[k]] = before[k];
      others_.put(static_cast<std::uint32_t>(members[k]), before[k]);
    }
  }

  const StepGraph& graph_;
  const std::vector<Vertex>& goals_;
  const std::vector<StepTable>& to_go_;
  std::vector<Path>& paths_;
  std::mt19937_64 random_;
  Occupation others_;
};

}  // namespace

std::optional<OneShotPlan> plan_one_shot(const StepGraph& graph, const std::vector<Vertex>& starts,
                                         const std::vector<Vertex>& goals, std::uint64_t seed,
                                         const OneShotBudget& budget) {
  std::vector<StepTable> to_go;
  for (const Vertex goal : goals) to_go.push_back(steps_to(graph, goal));

  const auto configurations = find_configurations(graph, starts, to_go, seed, budget.most_configurations);
  if (!configurations) return std::nullopt;

  std::vector<Path> paths(starts.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (const std::vector<Vertex>& at : *configurations) paths[i].push_back(at[i]);
    while (paths[i].size() > 1 && paths[i][paths[i].size() - 2] == goals[i]) paths[i].pop_back();
  }

  Improvement improvement(graph, goals, to_go, paths, seed);
  for (std::size_t round = 0; round < budget.rounds; ++round) improvement.round();

  OneShotPlan plan;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    plan.cost += paths[i].size() - 1;
    plan.least_cost += to_go[i][starts[i]];
    longest = std::max(longest, paths[i].size());
  }

  for (Path& path : paths) path.resize(longest, path.back());
  plan.paths = std::move(paths);
  return plan;
}

}  // namespace aisle::lab
