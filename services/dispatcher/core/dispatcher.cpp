#include "services/dispatcher/core/dispatcher.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

namespace aisle::dispatcher {
namespace {

/// The number in a goal's id: 2 of "agv-1/2"; none when it is no goal of this vehicle's mission.
std::optional<std::uint64_t> number_of(const std::string& goal_id, const std::string& agv_id) {
  const std::string head = agv_id + "/";
  if (goal_id.compare(0, head.size(), head) != 0) return std::nullopt;

  std::uint64_t number = 0;
  const char* const end = goal_id.data() + goal_id.size();
  const auto [stop, error] = std::from_chars(goal_id.data() + head.size(), end, number);

  return error == std::errc{} && stop == end ? std::optional(number) : std::nullopt;
}

}  // namespace

Dispatcher::Dispatcher(const std::vector<scenario::Mission>& missions, const Settings& settings, const Memory* memory)
    : settings_(settings) {
  for (const scenario::Mission& mission : missions) {
    Book book;
    book.mission = mission;

    if (memory != nullptr) {
      const auto kept = memory->find(mission.vehicle);
      book.remembered = kept != memory->end();
      if (book.remembered) book.progress = kept->second;
    }

    books_.emplace(mission.vehicle, std::move(book));
  }
}

void Dispatcher::vehicle_heard(const std::string& agv_id, time::Stamp now) {
  const auto found = books_.find(agv_id);
  if (found == books_.end() || found->second.stage != Stage::kUnseen) return;

  Book& book = found->second;

  book.stage = Stage::kGreeting;

  // With a memory the mission goes on at once; without one the vehicle has greet_s to tell what it was doing.
  book.due = book.remembered ? now : now + time::from_seconds(settings_.greet_s);

  if (book.status) greet(book, now);
}

void Dispatcher::status_heard(const std::string& agv_id, const Status& status, time::Stamp now) {
  const auto found = books_.find(agv_id);
  if (found == books_.end()) return;

  Book& book = found->second;
  book.status = status;

  if (book.stage == Stage::kGreeting) greet(book, now);
  if (book.stage == Stage::kOnTheWay || book.stage == Stage::kFailing) follow(book, now);
}

/// The vehicle told what it was doing: a goal of its mission is taken up at that number, without counting twice what a
/// memory has counted already.
void Dispatcher::greet(Book& book, time::Stamp now) {
  book.due = now;
  const std::optional<std::uint64_t> number = number_of(book.status->goal_id, book.mission.vehicle);
  const bool is_of_mission = number && *number < goal_count(book);

  if (is_of_mission && !book.remembered) {
    book.progress.next = *number;
    book.progress.reached = *number;
    tell(Event::Kind::kResumed, book, {});
  }

  book.remembered = true;
  if (is_of_mission && *number == book.progress.next && book.status->phase == Status::Phase::kArrived)
    decided(book, true, {}, now);
}

void Dispatcher::follow(Book& book, time::Stamp now) {
  const Status& status = *book.status;
  if (status.phase == Status::Phase::kOnTheWay) book.since = now;  // with whatever goal: it is left alone
  if (status.goal_id != goal_id(book)) return;

  switch (status.phase) {
    case Status::Phase::kArrived:
      decided(book, true, {}, now);
      break;

    case Status::Phase::kFailed:
      book.reason = status.reason;
      if (book.stage == Stage::kFailing) break;

      book.stage = Stage::kFailing;
      book.due = now + time::from_seconds(settings_.retry_s);
      break;

    case Status::Phase::kOnTheWay:
      book.stage = Stage::kOnTheWay;
      break;  // found a way after all

    case Status::Phase::kIdle:
      break;
  }
}

void Dispatcher::cancelled(const std::string& agv_id, const std::string& cancelled_goal_id) {
  const auto found = books_.find(agv_id);
  if (found == books_.end() || found->second.stage == Stage::kEnded || goal_id(found->second) != cancelled_goal_id)
    return;

  Book& book = found->second;
  tell(Event::Kind::kCancelled, book, "cancelled by a person; the mission ends here");

  ++book.progress.failed;
  book.progress.stopped = true;
  book.stage = Stage::kEnded;
}

void Dispatcher::decided(Book& book, bool reached, const std::string& reason, time::Stamp now) {
  tell(reached ? Event::Kind::kReached : Event::Kind::kFailed, book, reason);
  ++(reached ? book.progress.reached : book.progress.failed);
  ++book.progress.next;

  book.attempts = 0;
  book.reason.clear();

  book.stage = Stage::kGiving;
  book.due = now + time::from_seconds(settings_.pause_s);
}

std::vector<Order> Dispatcher::step(time::Stamp now) {
  std::vector<Order> orders;
  for (auto& [id, book] : books_) {
    if (book.stage == Stage::kUnseen || book.stage == Stage::kEnded) continue;

    if (book.progress.next >= goal_count(book) || book.progress.stopped) {
      book.stage = Stage::kEnded;
      tell(Event::Kind::kMissionDone, book, {});
      continue;
    }

    // Is anything due? A goal is given again to a vehicle which has not been driving for repeat_s.
    const bool is_on_the_way = book.stage == Stage::kOnTheWay;

    if (is_on_the_way ? now - book.since < time::from_seconds(settings_.repeat_s) : now < book.due) continue;

    // A failed goal is given again until its attempts are used up.
    if (book.stage == Stage::kFailing) {
      if (++book.attempts >= settings_.attempts) {
        decided(book, false, book.reason, now);
        continue;
      }

      tell(Event::Kind::kRetried, book, book.reason);
      book.due = now + time::from_seconds(settings_.retry_s);
    } else {
      book.stage = Stage::kOnTheWay;
      book.since = now;
    }

    orders.push_back(order_of(book));
  }

  return orders;
}

Order Dispatcher::order_of(const Book& book) const {
  const std::vector<geometry::Pose2>& goals = book.mission.goals_in_map;
  return {book.mission.vehicle, goal_id(book), goals[book.progress.next % goals.size()], settings_.position_tolerance_m,
          book.mission.heading_matters ? settings_.yaw_tolerance_rad : 0.0};
}

std::string Dispatcher::goal_id(const Book& book) const {
  return book.mission.vehicle + "/" + std::to_string(book.progress.next);
}

std::uint64_t Dispatcher::goal_count(const Book& book) const {
  return book.mission.goals_in_map.size() * static_cast<std::uint64_t>(std::max(1, book.mission.loops));
}

void Dispatcher::tell(Event::Kind kind, const Book& book, const std::string& reason) {
  events_.push_back({kind, book.mission.vehicle, goal_id(book), reason});
}

std::vector<Event> Dispatcher::take_events() { return std::exchange(events_, {}); }

bool Dispatcher::all_done() const {
  return std::all_of(books_.begin(), books_.end(),
                     [](const auto& entry) { return entry.second.stage == Stage::kEnded; });
}

std::uint64_t Dispatcher::assigned() const {
  std::uint64_t sum = reached() + failed();

  for (const auto& [id, book] : books_) sum += book.stage == Stage::kOnTheWay || book.stage == Stage::kFailing ? 1 : 0;
  return sum;
}

std::uint64_t Dispatcher::reached() const {
  std::uint64_t sum = 0;
  for (const auto& [id, book] : books_) sum += book.progress.reached;
  return sum;
}

std::uint64_t Dispatcher::failed() const {
  std::uint64_t sum = 0;
  for (const auto& [id, book] : books_) sum += book.progress.failed;
  return sum;
}

std::vector<std::string> Dispatcher::missing() const {
  std::vector<std::string> ids;
  for (const auto& [id, book] : books_) {
    if (book.stage == Stage::kUnseen) ids.push_back(id);
  }

  return ids;
}

std::set<std::string> Dispatcher::engaged() const {
  std::set<std::string> ids;
  for (const auto& [id, book] : books_) {
    if (book.stage != Stage::kEnded) ids.insert(id);
  }

  return ids;
}

Memory Dispatcher::memory() const {
  Memory memory;
  for (const auto& [id, book] : books_) memory[id] = book.progress;
  return memory;
}

}  // namespace aisle::dispatcher
