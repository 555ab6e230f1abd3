#include "services/local-planner/core/guard.hpp"

namespace aisle::local_planner {

using time::seconds;
using time::Stamp;

Guard::Guard(const Settings& settings)
    : late_s_(settings.late_s),
      late_hold_s_(settings.late_hold_s),
      stale_state_s_(settings.stale_state_s),
      stale_tracker_s_(settings.stale_tracker_s),
      plan_update_s_(settings.plan_update_s) {}

std::optional<double> Guard::begin(std::uint64_t map_revision, Stamp now) {
  // Since when the newest map is known.
  if (map_revision != map_revision_) {
    map_revision_ = map_revision;
    revision_changed_ = now;
  }

  const Stamp last_cycle = last_cycle_;
  last_cycle_ = now;
  if (last_cycle == Stamp{} || seconds(now - last_cycle) <= late_s_) return std::nullopt;

  late_ = now;

  return seconds(now - last_cycle);
}

std::optional<Stopped> Guard::judge(const Inputs& inputs, bool has_arrived, Stamp now) const {
  if (auto stopped = judge_state(inputs, now)) return stopped;
  if (inputs.clearance == nullptr) return Stopped{Phase::kWaiting, Reason::kNoMap};
  if (!inputs.plan) return Stopped{Phase::kWaiting, Reason::kNoGoal};
  if (inputs.plan->is_cancelled()) return Stopped{Phase::kHeld, Reason::kCancelled};
  if (auto stopped = judge_tracker(inputs, now)) return stopped;

  return judge_plan(inputs, has_arrived, now);
}

std::optional<Stopped> Guard::judge_state(const Inputs& inputs, Stamp now) const {
  if (!inputs.vehicle || !inputs.state.seen()) return Stopped{Phase::kWaiting, Reason::kNoState};
  if (inputs.authority_lost) return Stopped{Phase::kHeld, Reason::kAuthority};
  if (!inputs.state.fresh(now, time::from_seconds(stale_state_s_))) return Stopped{Phase::kHeld, Reason::kStaleState};
  if (inputs.is_held_by_person) return Stopped{Phase::kHeld, Reason::kPerson};
  if (late_ != Stamp{} && seconds(now - late_) < late_hold_s_) return Stopped{Phase::kHeld, Reason::kLate};

  return std::nullopt;
}

std::optional<Stopped> Guard::judge_tracker(const Inputs& inputs, Stamp now) const {
  if (inputs.tracker_alive == Stamp{}) return Stopped{Phase::kWaiting, Reason::kNoTracker, tracker_detail(inputs, now)};

  if (seconds(now - inputs.tracker_alive) > stale_tracker_s_)
    return Stopped{Phase::kHeld, Reason::kStaleTracker, tracker_detail(inputs, now)};
  return std::nullopt;
}

std::optional<Stopped> Guard::judge_plan(const Inputs& inputs, bool has_arrived, Stamp now) const {
  const Plan& plan = *inputs.plan;
  if (!plan.is_found() || plan.waypoints_in_map.empty())
    return Stopped{Phase::kFailed, Reason::kUnreachable, plan.detail};

  const bool is_outdated = plan.map_revision < inputs.map_revision && seconds(now - revision_changed_) > plan_update_s_;
  if (is_outdated && !has_arrived) return Stopped{Phase::kHeld, Reason::kPlanOutdated};

  return std::nullopt;
}

std::string Guard::tracker_detail(const Inputs& inputs, Stamp now) const {
  const bool tracker_lives = inputs.tracker_heard != Stamp{} && seconds(now - inputs.tracker_heard) <= stale_tracker_s_;
  return tracker_lives ? "the tracker works, but has no fresh scan of " + inputs.vehicle->id : "";
}

}  // namespace aisle::local_planner
