#include "tools/sim/standoffs.hpp"

#include <set>

namespace aisle::sim {
namespace {

/// Does anybody in the chain of waiting that begins at this vehicle move, or have an excuse?
bool is_anything_happening(const std::map<std::string, Doing>& fleet, const std::string& agv_id) {
  std::set<std::string> seen;
  std::vector<std::string> open{agv_id};

  while (!open.empty()) {
    const std::string next = open.back();
    open.pop_back();

    const auto found = fleet.find(next);
    if (found == fleet.end() || !seen.insert(next).second) continue;
    if (found->second.is_moving || found->second.is_excused) return true;

    open.insert(open.end(), found->second.waits_for.begin(), found->second.waits_for.end());
  }

  return false;
}

std::string cause_of(const Doing& doing) {
  std::string cause = doing.reason.empty() ? "no reason" : doing.reason;
  for (const std::string& other : doing.waits_for) cause += " " + other;
  return cause;
}

void take_longer(LongestStand& longest, double begin_s, double now_s, const std::string& agv_id, const Doing& doing) {
  if (now_s - begin_s > longest.seconds) longest = {now_s - begin_s, begin_s, agv_id, cause_of(doing)};
}

}  // namespace

void StandoffWatch::look(double now_s, const std::map<std::string, Doing>& fleet) {
  for (const auto& [agv_id, doing] : fleet) {
    const bool stands = doing.has_open_goal && !doing.is_moving;

    if (stands && !doing.is_excused) {
      take_longer(wait_, standing_since_.emplace(agv_id, now_s).first->second, now_s, agv_id, doing);
    } else {
      standing_since_.erase(agv_id);
    }

    if (stands && !is_anything_happening(fleet, agv_id)) {
      take_longer(standoff_, stuck_since_.emplace(agv_id, now_s).first->second, now_s, agv_id, doing);
    } else {
      stuck_since_.erase(agv_id);
    }
  }
}

}  // namespace aisle::sim
