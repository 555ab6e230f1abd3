#include "tools/lab/traffic_bounds/pibt_step.hpp"

#include <algorithm>

namespace aisle::lab {

PibtStep::PibtStep(const StepGraph& graph, std::uint64_t seed)
    : graph_(graph), random_(seed), stands_(graph.size(), kNobody), comes_(graph.size(), kNobody) {}

/// The vertices that the vehicle can be at after the step, the nearest to its goal first; of those as near, free ones
/// first, then by chance.
std::vector<Vertex> PibtStep::wishes_of(std::size_t vehicle) {
  const Vertex here = (*now_)[vehicle];
  const StepTable& to_go = *(*to_go_)[vehicle];

  std::vector<Vertex> wishes = graph_.neighbours[here];
  wishes.push_back(here);

  // Fisher and Yates by hand: std::shuffle may draw otherwise in another library.
  for (std::size_t i = wishes.size(); i > 1; --i) std::swap(wishes[i - 1], wishes[random_() % i]);

  std::stable_sort(wishes.begin(), wishes.end(), [&](Vertex a, Vertex b) {
    if (to_go[a] != to_go[b]) return to_go[a] < to_go[b];
    return stands_[a] == kNobody && stands_[b] != kNobody;
  });

  return wishes;
}

bool PibtStep::choose(std::size_t vehicle) {
  const Vertex here = (*now_)[vehicle];
  const auto number = static_cast<std::uint32_t>(vehicle);

  for (const Vertex wish : wishes_of(vehicle)) {
    const std::uint32_t there = stands_[wish];
    const bool is_other = there != kNobody && there != number;
    if (comes_[wish] != kNobody) continue;
    if (is_other && (*next_)[there] == here) continue;  // they would swap

    comes_[wish] = number;
    (*next_)[vehicle] = wish;
    touched_.push_back(wish);

    if (!is_other || (*next_)[there] != kNoVertex || choose(there)) return true;

    // The other one stays where it is, and holds that vertex now.
  }

  // It stays; the chooser that wanted its vertex looks further.
  comes_[here] = number;
  (*next_)[vehicle] = here;
  touched_.push_back(here);
  return false;
}

/// Do the moves that are prescribed go together?
bool PibtStep::take_prescribed(const std::vector<Vertex>& now, const std::vector<Vertex>& next) {
  for (std::size_t vehicle = 0; vehicle < next.size(); ++vehicle) {
    const Vertex to = next[vehicle];
    if (to == kNoVertex) continue;
    if (comes_[to] != kNobody) return false;

    const std::uint32_t there = stands_[to];
    if (there != kNobody && there != vehicle && next[there] == now[vehicle]) return false;

    comes_[to] = static_cast<std::uint32_t>(vehicle);
    touched_.push_back(to);
  }

  return true;
}

void PibtStep::clear() {
  for (const Vertex v : *now_) stands_[v] = kNobody;
  for (const Vertex v : touched_) comes_[v] = kNobody;
  touched_.clear();
}

bool PibtStep::plan(const std::vector<Vertex>& now, const std::vector<std::size_t>& order,
                    const std::vector<const StepTable*>& to_go, std::vector<Vertex>& next) {
  now_ = &now;
  to_go_ = &to_go;
  next_ = &next;
  for (std::size_t i = 0; i < now.size(); ++i) stands_[now[i]] = static_cast<std::uint32_t>(i);

  bool is_good = take_prescribed(now, next);
  for (const std::size_t vehicle : order)
    if (is_good && next[vehicle] == kNoVertex) is_good = choose(vehicle);

  clear();
  return is_good;
}

}  // namespace aisle::lab
