#include "services/dispatcher/core/task_pool.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace aisle::dispatcher {
namespace {

/// Of finished ones the oldest are forgotten beyond this; their ids could come again then.
constexpr std::size_t kMostTasks = 2000;

/// Straight ways between the stops from `first` on.
double way_between_m(const std::vector<TaskStop>& stops, std::size_t first) {
  double sum_m = 0.0;
  for (std::size_t i = first; i + 1 < stops.size(); ++i)
    sum_m += geometry::distance(stops[i].goal_in_map.position(), stops[i + 1].goal_in_map.position());
  return sum_m;
}

}  // namespace

std::vector<Task> tasks_of(const scenario::Scenario& scenario, const Settings& settings) {
  std::vector<Task> tasks;
  for (const scenario::Task& planned : scenario.tasks) {
    Task task;
    task.id = "task-" + std::to_string(tasks.size());
    const double yaw_tolerance_rad = planned.heading_matters ? settings.yaw_tolerance_rad : 0.0;

    for (std::size_t i = 0; i < planned.stops_in_map.size(); ++i) {
      const std::string goal_id = planned.stops_in_map.size() == 1 ? task.id : task.id + (i == 0 ? "/pick" : "/drop");
      task.stops.push_back({goal_id, planned.stops_in_map[i], settings.position_tolerance_m, yaw_tolerance_rad});
    }

    tasks.push_back(std::move(task));
  }

  return tasks;
}

TaskPool::TaskPool(const std::vector<Task>& tasks, const Settings& settings, const std::vector<TaskProgress>* memory)
    : settings_(settings), remembers_(memory != nullptr) {
  if (memory != nullptr) {
    for (const TaskProgress& kept : *memory) {
      Entry entry;
      entry.progress = kept;
      entries_.push_back(std::move(entry));
    }
  }

  for (const Task& task : tasks) add(task, {});
}

void TaskPool::add(const Task& task, time::Stamp now) {
  const auto is_same = [&](const Entry& entry) { return entry.progress.task.id == task.id; };
  if (std::any_of(entries_.begin(), entries_.end(), is_same)) return;

  if (entries_.size() >= kMostTasks) {
    const auto finished =
        std::find_if(entries_.begin(), entries_.end(), [](const Entry& entry) { return !entry.is_open(); });
    if (finished != entries_.end()) entries_.erase(finished);
  }

  Entry entry;
  entry.progress.task = task;
  entry.since = now;
  entries_.push_back(std::move(entry));
}

/// Waiting counts from the first vehicle on.
void TaskPool::vehicle_heard(const std::string& agv_id, double max_speed_mps, time::Stamp now) {
  if (!begun_) {
    begun_ = now;
    for (Entry& entry : entries_) entry.since = now;
  }

  vehicles_[agv_id].max_speed_mps = std::max(max_speed_mps, 0.01);
}

/// Of vehicles that have said what they are.
void TaskPool::place_heard(const std::string& agv_id, geometry::Point2 place_in_map, time::Stamp now) {
  const auto vehicle = vehicles_.find(agv_id);
  if (vehicle == vehicles_.end()) return;

  vehicle->second.place_in_map = place_in_map;
  vehicle->second.place_arrived = now;
}

void TaskPool::status_heard(const std::string& agv_id, const Status& status, double distance_left_m, time::Stamp now) {
  const auto found = vehicles_.find(agv_id);
  if (found == vehicles_.end()) return;

  VehicleEntry& vehicle = found->second;
  vehicle.status = status;
  vehicle.distance_left_m = distance_left_m;
  vehicle.status_arrived = now;

  take_up(agv_id, vehicle, now);
  if (Entry* const entry = find_given_to(agv_id)) follow(*entry, status, now);
}

void TaskPool::take_up(const std::string& agv_id, const VehicleEntry& vehicle, time::Stamp now) {
  const bool is_greeting = !remembers_ && now < *begun_ + time::from_seconds(settings_.greet_s);
  if (!is_greeting || vehicle.status->goal_id.empty() || find_given_to(agv_id) != nullptr) return;

  for (Entry& entry : entries_) {
    if (entry.progress.stage != Stage::kPending) continue;

    for (std::size_t i = 0; i < entry.progress.task.stops.size(); ++i) {
      if (entry.progress.task.stops[i].goal_id != vehicle.status->goal_id) continue;

      entry.progress.stage = Stage::kGiven;
      entry.progress.agv_id = agv_id;
      entry.progress.next = i;
      entry.is_ordered = true;
      entry.since = now;
      tell(Event::Kind::kResumed, entry, {});
      return;
    }
  }
}

void TaskPool::follow(Entry& entry, const Status& status, time::Stamp now) {
  if (status.phase == Status::Phase::kOnTheWay) entry.since = now;  // with whatever goal: it is left alone

  // A process that remembers a task has not written its goal itself, but the vehicle may have arrived meanwhile.
  if (status.goal_id != entry.stop().goal_id || (!entry.is_ordered && entry.due > now)) return;

  switch (status.phase) {
    case Status::Phase::kArrived:
      arrive(entry, now);
      break;

    case Status::Phase::kFailed:
      entry.reason = status.reason;
      if (entry.is_failing) break;

      entry.is_failing = true;
      entry.due = now + time::from_seconds(settings_.retry_s);
      break;

    case Status::Phase::kOnTheWay:
      entry.is_failing = false;
      break;

    case Status::Phase::kIdle:
      break;
  }
}

void TaskPool::arrive(Entry& entry, time::Stamp now) {
  tell(Event::Kind::kReached, entry, {});

  ++entry.progress.next;
  entry.is_failing = false;
  entry.is_ordered = false;
  entry.due = now + time::from_seconds(settings_.pause_s);

  if (entry.progress.next == entry.progress.task.stops.size()) entry.progress.stage = Stage::kDone;
}

void TaskPool::cancelled(const std::string& goal_id) {
  Entry* const entry = find_goal(goal_id);
  if (entry == nullptr || !entry->is_open()) return;

  tell(Event::Kind::kCancelled, *entry, "cancelled by a person; the task ends here");
  entry->progress.stage = Stage::kFailed;
}

/// First what is under way, so that vehicles that became free are seen by the pending tasks.
std::vector<Order> TaskPool::step(const std::set<std::string>& engaged, time::Stamp now) {
  std::vector<Order> orders;
  if (!begun_) return orders;

  for (Entry& entry : entries_) {
    if (entry.progress.stage == Stage::kGiven) continue_task(entry, now, orders);
  }

  const double greet_s = remembers_ ? 0.0 : settings_.greet_s;
  if (now >= *begun_ + time::from_seconds(greet_s)) assign(engaged, now, orders);

  return orders;
}

void TaskPool::continue_task(Entry& entry, time::Stamp now, std::vector<Order>& orders) {
  if (is_silent(entry.progress.agv_id, now)) {
    take_back(entry, entry.progress.agv_id + " is silent", now, orders);
    return;
  }

  if (entry.is_failing) {
    if (now >= entry.due) give_up(entry, now, orders);
    return;
  }

  // A goal is given again to a vehicle which has not been driving for repeat_s.
  const bool is_due = entry.is_ordered ? now - entry.since >= time::from_seconds(settings_.repeat_s) : now >= entry.due;
  if (!is_due) return;

  entry.is_ordered = true;
  entry.since = now;
  orders.push_back(order_of(entry));
}

void TaskPool::give_up(Entry& entry, time::Stamp now, std::vector<Order>& orders) {
  if (++entry.progress.attempts >= settings_.attempts) {
    tell(Event::Kind::kFailed, entry, entry.reason);
    entry.progress.stage = Stage::kFailed;
    return;
  }

  if (entry.progress.next == 0) {
    entry.tried.insert(entry.progress.agv_id);
    take_back(entry, entry.reason, now, orders);
    return;
  }

  tell(Event::Kind::kRetried, entry, entry.reason);
  entry.due = now + time::from_seconds(settings_.retry_s);
  orders.push_back(order_of(entry));
}

void TaskPool::take_back(Entry& entry, const std::string& reason, time::Stamp now, std::vector<Order>& orders) {
  tell(Event::Kind::kTakenBack, entry, reason);

  Order order = order_of(entry);
  order.is_cancelled = true;
  orders.push_back(std::move(order));

  entry.progress.stage = Stage::kPending;
  entry.progress.next = 0;
  entry.is_ordered = false;
  entry.is_failing = false;
  entry.since = now;
}

/// A vehicle with a person's goal counts where it is: where that goal lies is not known.
std::map<std::string, TaskPool::Free> TaskPool::candidates(const std::set<std::string>& engaged, time::Stamp now) {
  std::map<std::string, Free> candidates;
  for (const auto& [id, vehicle] : vehicles_) {
    if (engaged.count(id) > 0 || !vehicle.place_in_map || !vehicle.status || is_silent(id, now)) continue;

    Free free;
    free.speed_mps = vehicle.max_speed_mps;
    free.end_in_map = *vehicle.place_in_map;

    if (const Entry* const entry = find_given_to(id)) {
      const bool is_on_it = entry->is_ordered && vehicle.status->goal_id == entry->stop().goal_id;
      const double to_stop_m = is_on_it ? vehicle.distance_left_m
                                        : geometry::distance(free.end_in_map, entry->stop().goal_in_map.position());
      free.way_m = to_stop_m + way_between_m(entry->progress.task.stops, entry->progress.next);
      free.end_in_map = entry->progress.task.stops.back().goal_in_map.position();
      free.is_now = false;
    } else if (vehicle.status->phase == Status::Phase::kOnTheWay) {
      free.way_m = vehicle.distance_left_m;
      free.is_now = false;
    }

    candidates.emplace(id, free);
  }

  return candidates;
}

/// Candidates come by id, so an equal one does not displace a lower id.
const std::string* TaskPool::soonest(const Entry& entry, const std::map<std::string, Free>& candidates,
                                     time::Stamp now) const {
  const auto may_serve = [&](const auto& candidate) { return entry.tried.count(candidate.first) == 0; };
  const bool some_is_free = std::any_of(candidates.begin(), candidates.end(), [&](const auto& candidate) {
    return candidate.second.is_now && may_serve(candidate);
  });
  const bool takes_free_only = some_is_free && now - entry.since >= time::from_seconds(settings_.patience_s);

  const std::string* best = nullptr;
  std::tuple<double, bool> least{0.0, false};
  for (const auto& candidate : candidates) {
    const Free& free = candidate.second;
    if (!may_serve(candidate) || (takes_free_only && !free.is_now)) continue;

    const double to_stop_m = geometry::distance(free.end_in_map, entry.stop().goal_in_map.position());
    const std::tuple<double, bool> cost{(free.way_m + to_stop_m) / free.speed_mps, !free.is_now};
    if (best != nullptr && cost >= least) continue;

    best = &candidate.first;
    least = cost;
  }

  return best;
}

/// A task that waits for a busy vehicle lengthens that vehicle's work for the tasks after it.
void TaskPool::assign(const std::set<std::string>& engaged, time::Stamp now, std::vector<Order>& orders) {
  std::map<std::string, Free> candidates = this->candidates(engaged, now);
  if (candidates.empty()) return;

  for (Entry& entry : entries_) {
    if (entry.progress.stage != Stage::kPending) continue;

    const std::string* best = soonest(entry, candidates, now);
    if (best == nullptr) {  // each has tried
      entry.tried.clear();
      best = soonest(entry, candidates, now);
    }

    Free& free = candidates[*best];
    const std::vector<TaskStop>& stops = entry.progress.task.stops;

    if (free.is_now) {
      entry.progress.stage = Stage::kGiven;
      entry.progress.agv_id = *best;
      entry.is_ordered = true;
      entry.since = now;
      tell(Event::Kind::kGiven, entry, {});
      orders.push_back(order_of(entry));
    }

    free.way_m += geometry::distance(free.end_in_map, stops.front().goal_in_map.position()) + way_between_m(stops, 0);
    free.end_in_map = stops.back().goal_in_map.position();
    free.is_now = false;
  }
}

/// A vehicle speaks by both of its processes. One that was not heard since the start is silent since then.
bool TaskPool::is_silent(const std::string& agv_id, time::Stamp now) const {
  const time::Stamp life = time::from_seconds(settings_.silent_s);
  const auto found = vehicles_.find(agv_id);

  const bool is_known = found != vehicles_.end();
  const time::Stamp place = is_known && found->second.place_in_map ? found->second.place_arrived : *begun_;
  const time::Stamp status = is_known && found->second.status ? found->second.status_arrived : *begun_;
  return now - std::min(place, status) > life;
}

TaskPool::Entry* TaskPool::find_given_to(const std::string& agv_id) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.progress.stage == Stage::kGiven && entry.progress.agv_id == agv_id;
  });
  return found == entries_.end() ? nullptr : &*found;
}

TaskPool::Entry* TaskPool::find_goal(const std::string& goal_id) {
  const auto has_goal = [&](const Entry& entry) {
    const std::vector<TaskStop>& stops = entry.progress.task.stops;
    return std::any_of(stops.begin(), stops.end(), [&](const TaskStop& stop) { return stop.goal_id == goal_id; });
  };

  const auto found = std::find_if(entries_.begin(), entries_.end(), has_goal);
  return found == entries_.end() ? nullptr : &*found;
}

Order TaskPool::order_of(const Entry& entry) {
  const TaskStop& stop = entry.stop();
  return {entry.progress.agv_id, stop.goal_id, stop.goal_in_map, stop.position_tolerance_m, stop.yaw_tolerance_rad};
}

void TaskPool::tell(Event::Kind kind, const Entry& entry, const std::string& reason) {
  events_.push_back({kind, entry.progress.agv_id, entry.stop().goal_id, reason});
}

std::vector<Event> TaskPool::take_events() { return std::exchange(events_, {}); }

bool TaskPool::all_done() const {
  return std::none_of(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.is_open(); });
}

std::uint64_t TaskPool::assigned() const {
  std::uint64_t sum = reached() + failed();
  for (const Entry& entry : entries_) sum += entry.progress.stage == Stage::kGiven && entry.is_ordered ? 1 : 0;
  return sum;
}

std::uint64_t TaskPool::reached() const {
  std::uint64_t sum = 0;
  for (const Entry& entry : entries_) sum += entry.progress.next;
  return sum;
}

std::uint64_t TaskPool::failed() const {
  std::uint64_t sum = 0;
  for (const Entry& entry : entries_) {
    if (entry.progress.stage == Stage::kFailed) sum += entry.progress.task.stops.size() - entry.progress.next;
  }
  return sum;
}

std::vector<TaskProgress> TaskPool::memory() const {
  std::vector<TaskProgress> memory;
  memory.reserve(entries_.size());
  for (const Entry& entry : entries_) memory.push_back(entry.progress);
  return memory;
}

}  // namespace aisle::dispatcher
