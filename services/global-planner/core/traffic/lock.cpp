#include "services/global-planner/core/traffic/lock.hpp"

#include <algorithm>

namespace aisle::global_planner::traffic {
namespace {

std::pair<std::string, std::string> in_order(const std::string& a, const std::string& b) { return std::minmax(a, b); }

}  // namespace

Lock::Lock(double gap_m) : gap_m_(gap_m) {}

bool Lock::is_excepted(const std::string& a, const std::string& b) const {
  return !excepted_.empty() && excepted_.count(in_order(a, b)) > 0;
}

template <class Visit>
void Lock::each_meeting(const std::string& agv_id, const Shape& shape, Visit&& visit) const {
  if (shape.empty()) return;

  bool goes_on = true;
  bins_.visit(grown(shape.box(), gap_m_), [&](const Hold& hold) {
    if (!goes_on || *hold.agv_id == agv_id) return;

    const Shape& held = held_.at(*hold.agv_id).at(hold.step);
    if (meet(shape, held, gap_m_) && !is_excepted(agv_id, *hold.agv_id)) goes_on = visit(*hold.agv_id);
  });
}

bool Lock::admit(const std::string& agv_id, std::uint64_t step, const Shape& shape) {
  bool is_free = true;
  each_meeting(agv_id, shape, [&](const std::string&) { return is_free = false; });
  if (is_free) hold(agv_id, step, shape);

  return is_free;
}

bool Lock::keep(const std::string& agv_id, std::uint64_t step, const Shape& part) {
  const Steps& steps = held(agv_id);
  const auto is_held = [&](const Capsule& inner) {
    return std::any_of(steps.begin(), steps.lower_bound(kForced), [&](const auto& held) {
      const auto& capsules = held.second.capsules();
      return std::any_of(capsules.begin(), capsules.end(),
                         [&](const Capsule& outer) { return is_inside(inner, outer); });
    });
  };

  if (!std::all_of(part.capsules().begin(), part.capsules().end(), is_held)) return false;

  hold(agv_id, step, part);
  return true;
}

std::vector<std::string> Lock::holders(const std::string& agv_id, const Shape& shape) const {
  std::set<std::string> found;
  each_meeting(agv_id, shape, [&](const std::string& other) {
    found.insert(other);
    return true;
  });

  return {found.begin(), found.end()};
}

void Lock::force(const std::string& agv_id, const Shape& shape) {
  drop_forced(agv_id);
  hold(agv_id, kForced, shape);
}

void Lock::release(const std::string& agv_id, std::uint64_t step) { drop(agv_id, 0, step); }

void Lock::give_back(const std::string& agv_id, std::uint64_t step) { drop(agv_id, step, kForced); }

void Lock::except(const std::string& a, const std::string& b) { excepted_.insert(in_order(a, b)); }

void Lock::end_exception(const std::string& a, const std::string& b) { excepted_.erase(in_order(a, b)); }

void Lock::forget(const std::string& agv_id) {
  drop(agv_id, 0, kForced);
  drop_forced(agv_id);
  held_.erase(agv_id);

  for (auto pair = excepted_.begin(); pair != excepted_.end();)
    pair = pair->first == agv_id || pair->second == agv_id ? excepted_.erase(pair) : std::next(pair);
}

const std::map<std::uint64_t, Shape>& Lock::held(const std::string& agv_id) const {
  static const Steps none;
  const auto found = held_.find(agv_id);
  return found == held_.end() ? none : found->second;
}

void Lock::hold(const std::string& agv_id, std::uint64_t step, const Shape& shape) {
  if (shape.empty()) return;

  const auto vehicle = held_.try_emplace(agv_id).first;
  const Hold hold{&vehicle->first, step};
  Shape& held = vehicle->second[step];
  if (!held.empty()) bins_.remove(held.box(), hold);

  held.add(shape);
  bins_.add(held.box(), hold);
}

void Lock::drop(const std::string& agv_id, std::uint64_t from_step, std::uint64_t to_step) {
  const auto vehicle = held_.find(agv_id);
  if (vehicle == held_.end()) return;

  Steps& steps = vehicle->second;
  for (auto held = steps.lower_bound(from_step); held != steps.end() && held->first < to_step;) {
    bins_.remove(held->second.box(), {&vehicle->first, held->first});
    held = steps.erase(held);
  }
}

void Lock::drop_forced(const std::string& agv_id) {
  const auto vehicle = held_.find(agv_id);
  if (vehicle == held_.end()) return;

  const auto forced = vehicle->second.find(kForced);
  if (forced == vehicle->second.end()) return;

  bins_.remove(forced->second.box(), {&vehicle->first, kForced});
  vehicle->second.erase(forced);
}

}  // namespace aisle::global_planner::traffic
