#include "tools/referee/core/goal_book.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace aisle::referee {

const char* name_of(GoalOutcome outcome) {
  switch (outcome) {
    case GoalOutcome::kOpen:
      return "open";
    case GoalOutcome::kReached:
      return "reached";
    case GoalOutcome::kFailed:
      return "failed";
    case GoalOutcome::kCancelled:
      break;
  }

  return "cancelled";
}

GoalRecord* GoalBook::newest_of(const std::string& agv_id) {
  const auto found = newest_.find(agv_id);
  return found == newest_.end() ? nullptr : &goals_[found->second];
}

const GoalRecord* GoalBook::open_goal(const std::string& agv_id) const {
  const auto found = newest_.find(agv_id);
  if (found == newest_.end() || goals_[found->second].outcome != GoalOutcome::kOpen) return nullptr;
  return &goals_[found->second];
}

/// A goal that is given again by a dispatcher that restarted is no new goal.
void GoalBook::assigned(const GoalRecord& goal, bool cancelled) {
  GoalRecord* newest = newest_of(goal.agv_id);
  if (newest != nullptr && newest->goal_id == goal.goal_id) {
    if (cancelled && newest->outcome == GoalOutcome::kOpen) {
      newest->outcome = GoalOutcome::kCancelled;
      newest->decided_s = goal.assigned_s;
    }

    return;  // the same goal again, e.g. by a dispatcher that restarted
  }

  const auto known = std::find_if(goals_.begin(), goals_.end(), [&](const GoalRecord& g) {
    return g.agv_id == goal.agv_id && g.goal_id == goal.goal_id;
  });

  // Another goal takes its place.
  if (newest != nullptr && newest->outcome == GoalOutcome::kOpen) {
    newest->outcome = GoalOutcome::kFailed;
    newest->decided_s = goal.assigned_s;
    newest->reason =
        newest->reason.empty() ? "replaced by " + goal.goal_id : newest->reason + "; replaced by " + goal.goal_id;
  }

  if (cancelled) return;

  if (known != goals_.end()) {  // given a second time
    known->outcome = known->outcome == GoalOutcome::kReached ? GoalOutcome::kReached : GoalOutcome::kOpen;
    newest_[goal.agv_id] = static_cast<std::size_t>(known - goals_.begin());
    return;
  }

  goals_.push_back(goal);
  newest_[goal.agv_id] = goals_.size() - 1;
}

/// A claim to have arrived is checked against the truth.
void GoalBook::heard(const GoalNews& news, const geometry::Pose2& true_base_in_map) {
  GoalRecord* goal = newest_of(news.agv_id);
  if (goal == nullptr || goal->goal_id != news.goal_id || goal->outcome == GoalOutcome::kReached ||
      goal->outcome == GoalOutcome::kCancelled) {
    return;
  }

  if (news.phase != GoalNews::Phase::kArrived) {
    // A planner that comes back may still drive it: a failure is final only when the goal is replaced or the run ends.
    goal->reason = news.reason;

    const bool fails = news.phase == GoalNews::Phase::kFailed;
    if (!fails || goal->failing_since_s < 0.0) goal->failing_since_s = fails ? news.t_s : -1.0;

    return;
  }

  const double off_m = geometry::distance(true_base_in_map.position(), goal->pose_in_map.position());
  if (off_m <= goal->position_tolerance_m + kSlack_m) {
    goal->outcome = GoalOutcome::kReached;
    goal->decided_s = news.t_s;
    goal->reason.clear();
  } else {
    goal->reason = fmt::format("claims to have arrived {:.2f} m away from it", off_m);
  }
}

/// Keeps what was said last as the reason.
void GoalBook::close(double t_s) {
  for (GoalRecord& goal : goals_) {
    if (goal.outcome != GoalOutcome::kOpen) continue;

    goal.outcome = GoalOutcome::kFailed;
    goal.decided_s = t_s;
    goal.reason =
        goal.reason.empty() ? "not reached before the end of the run" : goal.reason + " until the end of the run";
  }
}

int GoalBook::assigned_count(const std::string& agv_id) const {
  return static_cast<int>(
      std::count_if(goals_.begin(), goals_.end(), [&](const GoalRecord& g) { return g.agv_id == agv_id; }));
}

int GoalBook::count(GoalOutcome outcome) const {
  return static_cast<int>(
      std::count_if(goals_.begin(), goals_.end(), [&](const GoalRecord& g) { return g.outcome == outcome; }));
}

}  // namespace aisle::referee
