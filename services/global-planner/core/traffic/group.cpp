#include "services/global-planner/core/traffic/group.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace aisle::global_planner::traffic {
namespace {

constexpr std::size_t kMostMembers = 12;
constexpr std::size_t kMostImproved = 6;
constexpr double kMostPostponedS = 0.5;  // the oldest goal, by all that is improved while it is the oldest
constexpr double kSameAgeS = 0.1;        // of goals that were given together
constexpr double kLeastLossS = 2.0;      // a plan that ends sooner after the free run is not improved

// No further order is tried after so many expanded states.
constexpr std::uint64_t kMostExpanded = 12'000;

// Rests of members count so long, one try after the other. Forecasts that are too long do no harm: only the order is
// kept, and retiming takes the waits out.
constexpr std::array<double, 6> kSoftRestsS{6.0, 15.0, 40.0, 15.0, 40.0, 90.0};

/// The next number of a linear congruential generator (Knuth, MMIX), below `limit`.
std::size_t random_below(std::uint64_t& state, std::size_t limit) {
  state = state * 6364136223846793005ULL + 1442695040888963407ULL;
  return static_cast<std::size_t>((state >> 33U) % limit);
}

template <class Item>
void shuffle(std::vector<Item>& items, std::size_t first, std::uint64_t& random_state) {
  for (std::size_t i = items.size(); i > first + 1; --i)
    std::swap(items[i - 1], items[first + random_below(random_state, i - first)]);
}

/// Older goals first, those without a goal last.
bool is_older(const Agent* a, const Agent* b) {
  if ((a->goal == kNoId) != (b->goal == kNoId)) return b->goal == kNoId;
  return a->goal_since_s != b->goal_since_s ? a->goal_since_s < b->goal_since_s : a->number < b->number;
}

}  // namespace

/// Those on the agent's way if nobody had a plan, and those planned to pass where it rests; the agent first.
GroupPlanner::Members GroupPlanner::those_in_the_way(Agent& agent, double now_s) {
  std::vector<std::string> ids;
  if (agent.goal != kNoId) {
    if (const auto way = parts_.ways.way_past_plans(agent, now_s)) ids = parts_.timetable.those_met(agent, *way);
  }
  for (const auto& [id, other] : parts_.timetable.agents()) {
    for (std::size_t i = other.pending(); i < other.steps.size(); ++i)
      for (const Link& link : other.steps[i].links)
        if (link.agent == agent.number && link.step >= agent.granted) ids.push_back(id);
  }

  Members members{&agent};
  for (const std::string& id : ids) {
    Agent* other = parts_.timetable.find(id);
    const bool is_known = std::find(members.begin(), members.end(), other) != members.end();
    if (!other->is_frozen && !is_known && members.size() < kMostMembers) members.push_back(other);
  }
  std::sort(members.begin() + 1, members.end(), is_older);
  return members;
}

/// The ends of the first `planned` members, and of the others as if they drove alone, from `now_s`; of those with
/// goals.
double GroupPlanner::least_sum_of_ends_s(const Members& order, std::size_t planned, double now_s) {
  double sum_s = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Agent& member = *order[i];
    if (member.goal == kNoId) continue;
    sum_s += i < planned ? parts_.timetable.end_s(member, now_s) - now_s
                         : parts_.timetable.departure(member, now_s).time_s - now_s + parts_.ways.alone_s(member);
  }
  return sum_s;
}

/// All members end their plans where their grants end; then one after the other plans anew.
/// @param most_sum_s it is given up when the ends of those with goals come to more
/// @return has the first one what it needs, and is nobody in the way of the others?
bool GroupPlanner::plan_in_order(const Members& order, double now_s, const WayFinder::Terms& terms, double most_sum_s) {
  for (Agent* member : order) parts_.timetable.drop_from(*member, member->granted);

  Agent& first = *order.front();
  const bool has_plan = first.goal != kNoId && parts_.ways.ahead_in_queue(first) == nullptr
                            ? parts_.ways.go(first, now_s, terms)
                            : parts_.ways.leave(first, now_s, terms);
  if (!has_plan) return false;

  for (std::size_t i = 1; i < order.size(); ++i) {
    if (most_sum_s < kForEver && least_sum_of_ends_s(order, i, now_s) > most_sum_s) return false;
    if (!parts_.ways.go_or_leave(*order[i], now_s, terms)) return false;
  }

  for (const Agent* member : order)
    if (!parts_.ways.clear_way_of(*member, now_s, terms)) return false;
  return true;
}

bool GroupPlanner::plan(Agent& agent, double now_s) {
  Members members = those_in_the_way(agent, now_s);
  std::uint64_t random_state = agent.number + 1;
  const std::uint64_t most_expanded = parts_.search.expanded() + kMostExpanded;

  for (std::size_t i = 0; i < kSoftRestsS.size() && parts_.search.expanded() < most_expanded; ++i) {
    if (i >= 3) shuffle(members, 1, random_state);
    parts_.timetable.begin_trial();
    if (plan_in_order(members, now_s, {kSoftRestsS[i]})) {
      parts_.timetable.keep_trial();
      for (Agent* member : members) {
        const bool makes_way = member != &agent && member->goal != kNoId && !member->has_plan_to_goal;
        member->waits_for = makes_way ? std::vector<std::string>{agent.id} : std::vector<std::string>{};
        member->reason = makes_way ? "makes way for " + agent.id : "";
      }
      return true;
    }
    parts_.timetable.undo_trial();
  }
  return false;
}

double GroupPlanner::sum_of_ends_s(double now_s) const {
  double sum_s = 0.0;
  for (const auto& [id, agent] : parts_.timetable.agents())
    if (agent.has_plan_to_goal) sum_s += parts_.timetable.end_s(agent, now_s) - now_s;
  return sum_s;
}

/// How much later it ends than it would alone.
double GroupPlanner::lost_s(const Agent& agent, double now_s) {
  const double start_s = parts_.timetable.departure(agent, now_s).time_s;
  return parts_.timetable.end_s(agent, now_s) - start_s - parts_.ways.alone_s(agent);
}

/// Among four vehicles at random that which ends latest after what it would need alone.
Agent* GroupPlanner::most_late(double now_s, std::uint64_t& random_state) {
  std::vector<Agent*> candidates;
  for (auto& [id, agent] : parts_.timetable.agents())
    if (agent.has_plan_to_goal && !agent.is_frozen && agent.pending() < agent.steps.size())
      candidates.push_back(&agent);
  if (candidates.empty()) return nullptr;

  shuffle(candidates, 0, random_state);
  candidates.resize(std::min<std::size_t>(candidates.size(), 4));

  Agent* worst = nullptr;
  double most_s = 0.0;
  for (Agent* agent : candidates) {
    const double loss_s = lost_s(*agent, now_s);
    if (worst != nullptr && loss_s <= most_s) continue;
    worst = agent;
    most_s = loss_s;
  }
  return worst;
}

std::size_t GroupPlanner::number_with_plan() const {
  const auto& agents = parts_.timetable.agents();
  return static_cast<std::size_t>(
      std::count_if(agents.begin(), agents.end(), [](const auto& agent) { return agent.second.has_plan_to_goal; }));
}

/// The vehicle with the oldest goal; among those as old, the one that loses most. @pre one has a plan to its goal
const Agent* GroupPlanner::oldest_with_plan(double now_s) {
  double since_s = kForEver;
  for (const auto& [id, agent] : parts_.timetable.agents())
    if (agent.has_plan_to_goal) since_s = std::min(since_s, agent.goal_since_s);

  const Agent* oldest = nullptr;
  double most_s = 0.0;
  for (const auto& [id, agent] : parts_.timetable.agents()) {
    if (!agent.has_plan_to_goal || agent.goal_since_s > since_s + kSameAgeS) continue;

    const double loss_s = lost_s(agent, now_s);
    if (oldest != nullptr && loss_s <= most_s) continue;
    oldest = &agent;
    most_s = loss_s;
  }
  return oldest;
}

GroupPlanner::Members GroupPlanner::those_waited_for(Agent& agent) {
  Members members{&agent};
  for (std::size_t i = agent.pending(); i < agent.steps.size(); ++i)
    for (const Link& link : agent.steps[i].links) {
      Agent* other = parts_.timetable.at(link.agent);
      if (other == nullptr || other->is_frozen || members.size() >= kMostImproved) continue;
      if (std::find(members.begin(), members.end(), other) == members.end()) members.push_back(other);
    }
  return members;
}

/// How: those that meet on their own ways may both have to leave them, as two that come from either end of an aisle: an
/// own way keeps to its middle. So every other try is by the roadmap alone, whose ways lie side by side.
bool GroupPlanner::improve(double now_s, std::uint64_t& random_state) {
  Agent* late = most_late(now_s, random_state);
  if (late == nullptr || lost_s(*late, now_s) < kLeastLossS) return false;

  Members members = those_waited_for(*late);
  shuffle(members, 0, random_state);
  WayFinder::Terms terms{parts_.settings.soft_rest_s};
  terms.is_roadmap_only = random_below(random_state, 2) == 0;

  const Agent* oldest = oldest_with_plan(now_s);
  const std::size_t with_plan = number_with_plan();
  const double oldest_end_s = parts_.timetable.end_s(*oldest, now_s);
  double postponed_s = 0.0;
  JointPlan::Patience& patience = parts_.patience;
  if (patience.agent != oldest->number || patience.goal_since_s != oldest->goal_since_s)
    patience = {oldest->number, oldest->goal_since_s, 0.0};
  const double before_s = sum_of_ends_s(now_s);

  // As long as all members keep their goals; whether others lose is seen in the end.
  const bool all_have_plans = std::all_of(members.begin(), members.end(), [](const Agent* member) {
    return member->goal == kNoId || member->has_plan_to_goal;
  });
  const double most_sum_s = all_have_plans ? least_sum_of_ends_s(members, members.size(), now_s) : kForEver;

  parts_.timetable.begin_trial();
  bool is_better = plan_in_order(members, now_s, terms, most_sum_s);
  if (is_better) {
    postponed_s = std::max(0.0, parts_.timetable.end_s(*oldest, now_s) - oldest_end_s);
    is_better = number_with_plan() >= with_plan && patience.spent_s + postponed_s <= kMostPostponedS &&
                sum_of_ends_s(now_s) < before_s - 0.1;
  }
  if (is_better) {
    patience.spent_s += postponed_s;
    parts_.timetable.keep_trial();
  } else {
    parts_.timetable.undo_trial();
  }
  return is_better;
}

}  // namespace aisle::global_planner::traffic
