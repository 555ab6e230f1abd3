// Distance tables of the roadmap: backward from a goal.
#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "services/global-planner/core/traffic/roadmap.hpp"

namespace aisle::global_planner::traffic {
namespace {

constexpr double kNoWay = std::numeric_limits<double>::infinity();

/// Seconds for the motion alone, without a turn before it.
double seconds_of(const Roadmap& roadmap, const Motion& motion) {
  return run_s(roadmap.kind(motion.kind), motion, motion.entry_rad, false);
}

/// May a way lead over the motion? Closed ones only from a closed place: out of it.
bool is_usable(const Roadmap& roadmap, const Motion& motion) {
  if (motion.is_blocked) return false;

  const bool is_from_closed = roadmap.place(motion.from).is_closed;
  return is_from_closed || (!motion.is_closed && !roadmap.place(motion.to).is_closed);
}

}  // namespace

/// Dijkstra against the direction of the motions.
const std::vector<double>& Roadmap::seconds_to(PlaceId goal) {
  const auto known = seconds_to_.find(goal);
  if (known != seconds_to_.end()) return known->second;

  using Entry = std::pair<double, PlaceId>;
  std::vector<double>& table = seconds_to_[goal];
  table.assign(places_.size(), kNoWay);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  if (goal < table.size()) {
    table[goal] = 0.0;
    open.push({0.0, goal});
  }

  while (!open.empty()) {
    const auto [so_far_s, to] = open.top();
    open.pop();
    if (so_far_s > table[to]) continue;

    for (const MotionId id : place(to).entering) {
      const Motion& motion = *motions_[id];
      if (!is_usable(*this, motion)) continue;

      const double seconds = so_far_s + seconds_of(*this, motion);
      if (seconds >= table[motion.from]) continue;

      table[motion.from] = seconds;
      if (!places_[motion.from]->is_temporary) open.push({seconds, motion.from});
    }
  }

  for (const PlaceId id : temporary_places_)
    if (id != goal && id < table.size()) table[id] = kNoWay;

  return table;
}

double Roadmap::seconds_to(PlaceId from, PlaceId goal) {
  if (from == goal) return 0.0;

  const std::vector<double>& table = seconds_to(goal);
  if (from < table.size() && !place(from).is_temporary) return table[from];

  // Over temporary places, up to the first of the others.
  using Entry = std::pair<double, PlaceId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::map<PlaceId, double> reached{{from, 0.0}};
  open.push({0.0, from});
  double best_s = kNoWay;

  while (!open.empty() && open.top().first < best_s) {
    const auto [so_far_s, at] = open.top();
    open.pop();
    if (so_far_s > reached[at]) continue;
    if (at < table.size() && (at == goal || !place(at).is_temporary)) best_s = std::min(best_s, so_far_s + table[at]);
    if (!place(at).is_temporary) continue;

    for (const MotionId id : place(at).leaving) {
      const Motion& motion = *motions_[id];
      const double seconds = so_far_s + seconds_of(*this, motion);
      const auto entry = reached.try_emplace(motion.to, kNoWay).first;
      if (!is_usable(*this, motion) || seconds >= entry->second) continue;

      entry->second = seconds;
      open.push({seconds, motion.to});
    }
  }

  return best_s;
}

}  // namespace aisle::global_planner::traffic
