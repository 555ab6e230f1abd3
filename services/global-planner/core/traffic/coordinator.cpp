#include "services/global-planner/core/traffic/coordinator.hpp"

#include <algorithm>
#include <utility>

namespace aisle::global_planner::traffic {
namespace {

constexpr double kRetimeS = 0.5;
constexpr double kImproveS = 0.1;      // between two tries after one that helped
constexpr double kSoonImproveS = 0.5;  // at most, after a change
constexpr double kRarelyImproveS = 4.0;
constexpr int kImproveTries = 6;                   // at a time, in small fleets; in large ones
constexpr std::uint64_t kImproveExpanded = 2'000;  // states are enough

// States that improvement may expand: in large fleets, where a search expands more, fewer by the number of vehicles.
constexpr double kImproveExpandedPerS = 30'000.0;
constexpr std::size_t kLargeFleet = 10;
constexpr double kMostImproveSaved = 4'000.0;

// Groups, and searches that were in vain once, have a budget of states, so that a crowded floor takes no more computing
// time than there is. It is saved up to some seconds of it.
constexpr double kTriesExpandedPerS = 20'000.0;
constexpr double kSweepS = 2.0;
constexpr double kSettleS = 0.2;  // after a goal: so long plans that make way for it may still become better

JointPlan::Settings plan_settings(double gap_m) {
  JointPlan::Settings settings;
  settings.gap_m = gap_m;
  return settings;
}

}  // namespace

Coordinator::Coordinator(const Settings& settings, OwnWay own_way)
    : settings_(settings),
      own_way_(std::move(own_way)),
      roadmap_(settings.gap_m),
      lock_(settings.gap_m),
      plans_(roadmap_, plan_settings(settings.gap_m)) {}

void Coordinator::set_map(const grid::ClearanceField& clearance, grid::Cell low, grid::Cell high) {
  roadmap_.set_map(clearance, low, high);
  has_map_ = true;
  has_changed_ = true;
}

void Coordinator::set_zones(const std::vector<fleet::Zone>& zones, double now_s) {
  if (zones == roadmap_.zones().zones()) return;

  roadmap_.set_zones(zones);
  has_changed_ = true;
  plans_changed();
  sweep(now_s);

  // Places of goals in the zones were made anew.
  for (auto& [id, vehicle] : vehicles_)
    if (vehicle.is_registered) set_agent_goal(vehicle, now_s);
}

/// One slice: first what became of the floor, then plans, then grants, which are never kept waiting.
Orders Coordinator::step(double now_s) {
  is_busy_ = false;
  grow_budgets(now_s);

  for (auto& [id, vehicle] : vehicles_)
    if (!vehicle.is_registered) register_vehicle(vehicle, now_s);

  if (now_s >= swept_s_ + kSweepS) sweep(now_s);

  part_near_ones(now_s);
  look_for_silence(now_s);
  look_for_strays(now_s);
  look_for_blocks(now_s);
  if (has_changed_) leave_closed_floor(now_s);

  plan_those_without(now_s);
  move_resters(now_s);

  if (now_s >= retimed_s_ + kRetimeS) {
    plans_.retime(now_s);
    retimed_s_ = now_s;
  }

  is_settling_ = now_s < newest_goal_s_ + kSettleS;
  if (!is_busy_) retry_own_way(now_s);
  if (!is_busy_) improve(now_s);

  grant_all();

  // A silent vehicle is told nothing: it may have road that this leader does not know, and must go on naming its grant.
  Orders orders;
  for (auto& [id, vehicle] : vehicles_) {
    if (vehicle.is_registered && !vehicle.is_silent) tell_way(vehicle, orders);
  }

  orders.events.swap(events_);
  return orders;
}

std::uint64_t Coordinator::take_plan_id(const std::string& agv_id) {
  const auto found = vehicles_.find(agv_id);
  return found == vehicles_.end() ? 0 : found->second.next_plan_id++;
}

/// Time gives states to expand.
void Coordinator::grow_budgets(double now_s) {
  const double since_s = std::max(0.0, now_s - budgets_grown_s_);
  const double share = static_cast<double>(kLargeFleet) / std::max(kLargeFleet, vehicles_.size());
  budgets_grown_s_ = now_s;

  improve_expanded_ = std::min(kMostImproveSaved, improve_expanded_ + since_s * kImproveExpandedPerS * share);
  tries_expanded_ = std::min(kMostTriesSaved, tries_expanded_ + since_s * kTriesExpandedPerS);
}

/// Tries that are in vain become rarer; a change makes them more frequent again.
void Coordinator::improve(double now_s) {
  if (!is_settling_ && now_s < improved_s_ + improve_every_s_) return;

  improved_s_ = now_s;
  if (improve_expanded_ <= 0.0) return;

  bool is_better = false;
  const std::uint64_t before = plans_.expanded();
  const std::uint64_t most_expanded = before + kImproveExpanded;
  for (int i = 0; i < kImproveTries && !is_better && plans_.expanded() < most_expanded; ++i)
    is_better = plans_.improve(now_s, random_state_);
  improve_expanded_ -= static_cast<double>(plans_.expanded() - before);
  improve_every_s_ = is_better ? kImproveS : std::min(1.5 * improve_every_s_, kRarelyImproveS);
}

/// Something that improvement may make use of.
void Coordinator::plans_changed() { improve_every_s_ = std::min(improve_every_s_, kSoonImproveS); }

bool Coordinator::is_on_own_way(const std::string& agv_id, std::uint64_t step) const {
  const auto found = plans_.agents().find(agv_id);
  if (found == plans_.agents().end() || step < found->second.done) return false;

  const std::size_t index = step - found->second.done;
  return index < found->second.steps.size() && found->second.steps[index].is_own_way;
}

}  // namespace aisle::global_planner::traffic
