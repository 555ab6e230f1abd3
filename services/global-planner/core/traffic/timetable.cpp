#include "services/global-planner/core/traffic/timetable.hpp"

#include <algorithm>
#include <utility>

namespace aisle::global_planner::traffic {
namespace {

using Use = Reservation::Use;

}  // namespace

Timetable::Timetable(const Roadmap& roadmap, Meetings& meetings, double merge_s, double soft_rest_s)
    : roadmap_(roadmap), meetings_(meetings), reservations_(meetings, merge_s), soft_rest_s_(soft_rest_s) {}

Agent& Timetable::add(const std::string& agv_id, KindId kind, PlaceId place, double heading_rad,
                      std::uint64_t first_step) {
  Agent& agent = agents_[agv_id];
  agent.id = agv_id;
  agent.kind = kind;
  agent.place = place;
  agent.heading_rad = heading_rad;
  agent.done = first_step;
  agent.granted = first_step;
  agent.number = static_cast<std::uint32_t>(by_number_.size());
  by_number_.push_back(&agent);
  books_.emplace_back();
  write_rest(agent);
  relink(agent);
  return agent;
}

void Timetable::remove(const std::string& agv_id) {
  const auto found = agents_.find(agv_id);
  if (found == agents_.end()) return;

  Agent& agent = found->second;
  agent.steps.clear();
  unlink(agent);
  Book& book = books_[agent.number];
  erase_book(book, 0);
  erase_rest(book);
  by_number_[agent.number] = nullptr;
  agents_.erase(found);
}

Agent* Timetable::find(const std::string& agv_id) {
  const auto found = agents_.find(agv_id);
  return found == agents_.end() ? nullptr : &found->second;
}

PlaceId Timetable::end_of(const Agent& agent, std::size_t steps) const {
  return steps == 0 ? agent.place : roadmap_.motion(agent.steps[steps - 1].motion).to;
}

double Timetable::end_s(const Agent& agent, double now_s) const {
  return agent.steps.empty() ? now_s : agent.steps.back().end_s;
}

Departure Timetable::departure(const Agent& agent, double now_s) const {
  const std::size_t pending = agent.pending();
  Departure out{agent.kind, granted_end(agent), now_s, agent.heading_rad, true, kNoId};
  if (pending == 0) return out;

  const Step& last = agent.steps[pending - 1];
  out.time_s = std::max(now_s, last.end_s);
  out.heading_rad = roadmap_.motion(last.motion).exit_rad;
  out.is_standing = false;
  out.before = last.motion;
  return out;
}

Step Timetable::step_of(const Leg& leg, MotionId before, bool is_own_way) {
  Step step;
  step.motion = leg.motion;
  step.shape = roadmap_.motion(leg.motion).shape;
  const ShapeId corner = before == kNoId ? kNoId : meetings_.of_corner(before, leg.motion);
  if (corner != kNoId) step.shape.add(meetings_.shape(corner));
  step.begin_s = leg.begin_s;
  step.end_s = leg.end_s;
  step.is_own_way = is_own_way;
  step.before = before;
  return step;
}

void Timetable::replace_tail(Agent& agent, const std::vector<Leg>& legs, bool is_own_way) {
  std::vector<Step> tail;
  MotionId before = agent.pending() == 0 ? kNoId : agent.steps[agent.pending() - 1].motion;
  for (const Leg& leg : legs) {
    tail.push_back(step_of(leg, before, is_own_way));
    before = leg.motion;
  }

  save_tail(agent);
  set_tail(agent, std::move(tail));
}

void Timetable::set_tail(Agent& agent, std::vector<Step> tail) {
  unlink(agent);
  erase_book(books_[agent.number], agent.pending());
  agent.steps.resize(agent.pending());
  for (Step& step : tail) {
    step.links.clear();
    agent.steps.push_back(std::move(step));
  }

  write_book(agent);
  write_rest(agent);
  relink(agent);
  agent.has_plan_to_goal = agent.goal != kNoId && rest_place(agent) == agent.goal;
}

void Timetable::drop_from(Agent& agent, std::uint64_t step) {
  if (step >= agent.beyond()) return;

  if (step < agent.granted) {
    // What was granted cannot come back by undoing a trial, so this is no part of one.
    agent.granted = step;
    erase_book(books_[agent.number], agent.pending());
  } else {
    save_tail(agent);
  }

  std::vector<Step> kept(agent.steps.begin() + static_cast<std::ptrdiff_t>(agent.pending()),
                         agent.steps.begin() + static_cast<std::ptrdiff_t>(step - agent.done));
  set_tail(agent, std::move(kept));
}

void Timetable::grant_next(Agent& agent) {
  if (agent.pending() == agent.steps.size()) return;

  agent.steps[agent.pending()].links.clear();
  ++agent.granted;
  write_times(agent);
}

void Timetable::report(Agent& agent, std::uint64_t done, double now_s) {
  const std::uint64_t behind = std::min(done, agent.granted);
  if (behind <= agent.done) return;

  const std::size_t count = static_cast<std::size_t>(behind - agent.done);
  const Motion& last = roadmap_.motion(agent.steps[count - 1].motion);
  agent.place = last.to;
  agent.heading_rad = last.exit_rad;
  agent.done = behind;

  Book& book = books_[agent.number];
  for (std::size_t i = 0; i < count; ++i) {
    reservations_.remove(book.steps[i].motion);
    reservations_.remove(book.steps[i].wait);
    if (book.steps[i].corner != kNoId) reservations_.remove(book.steps[i].corner);
  }
  book.steps.erase(book.steps.begin(), book.steps.begin() + static_cast<std::ptrdiff_t>(count));
  agent.steps.erase(agent.steps.begin(), agent.steps.begin() + static_cast<std::ptrdiff_t>(count));

  if (agent.pending() > 0) {
    Step& now = agent.steps.front();
    now.end_s = now_s + (now.end_s - now.begin_s);
    now.begin_s = now_s;
  }
  write_times(agent);
}

void Timetable::set_frozen(Agent& agent, bool is_frozen) {
  agent.is_frozen = is_frozen;
  write_times(agent);
}

bool Timetable::is_done(const Link& link) const {
  const Agent* agent = by_number_[link.agent];
  return agent == nullptr || agent->done > link.step;
}

// ---- What is reserved ----

void Timetable::erase_book(Book& book, std::size_t from) {
  for (std::size_t i = from; i < book.steps.size(); ++i) {
    reservations_.remove(book.steps[i].motion);
    reservations_.remove(book.steps[i].wait);
    if (book.steps[i].corner != kNoId) reservations_.remove(book.steps[i].corner);
  }
  book.steps.resize(std::min(from, book.steps.size()));
}

/// Reserves the steps that are not yet in the book.
void Timetable::write_book(const Agent& agent) {
  Book& book = books_[agent.number];
  for (std::size_t i = book.steps.size(); i < agent.steps.size(); ++i) {
    Reservation entry;
    entry.agent = agent.number;
    entry.step = agent.done + i;

    const MotionId motion = agent.steps[i].motion;
    StepBook step;
    entry.shape = meetings_.of_motion(motion);
    step.motion = reservations_.add(entry);

    const MotionId before = agent.steps[i].before;
    const ShapeId corner = before == kNoId ? kNoId : meetings_.of_corner(before, motion);
    if (corner != kNoId) {
      entry.shape = corner;
      step.corner = reservations_.add(entry);
    }

    entry.use = Use::kWait;
    entry.shape = meetings_.of_place(roadmap_.motion(motion).from);
    step.wait = reservations_.add(entry);
    book.steps.push_back(step);
  }
}

void Timetable::erase_rest(Book& book) {
  if (book.corridor != kNoId) {
    auto& rests = corridor_rests_[book.corridor];
    rests.erase(std::find(rests.begin(), rests.end(), book.rest));
    if (rests.empty()) corridor_rests_.erase(book.corridor);
  }
  if (book.rest != kNoId) reservations_.remove(book.rest);
  book.corridor = kNoId;
  book.rest = kNoId;
}

void Timetable::write_rest(const Agent& agent) {
  Book& book = books_[agent.number];
  erase_rest(book);

  Reservation entry;
  entry.agent = agent.number;
  entry.step = agent.beyond();
  entry.use = Use::kRest;
  entry.shape = meetings_.of_place(rest_place(agent));
  book.rest = reservations_.add(entry);

  book.corridor = roadmap_.place(rest_place(agent)).corridor;
  if (book.corridor != kNoId) corridor_rests_[book.corridor].push_back(book.rest);
  write_times(agent);
}

void Timetable::write_times(const Agent& agent) {
  const Book& book = books_[agent.number];
  double free_s = -kForEver;  // when the step before ends
  for (std::size_t i = 0; i < agent.steps.size(); ++i) {
    const Step& step = agent.steps[i];
    const bool is_granted = i < agent.pending();
    const double end_s = agent.is_frozen && is_granted ? kForEver : step.end_s;

    const auto write = [&](ReservationId id, double from_s, double to_s) {
      if (id == kNoId) return;
      Reservation& entry = reservations_[id];
      entry.from_s = is_granted ? -kForEver : from_s;
      entry.to_s = to_s;
      entry.is_granted = is_granted;
      entry.is_frozen = agent.is_frozen && is_granted;
    };
    write(book.steps[i].motion, step.begin_s, end_s);
    write(book.steps[i].corner, step.begin_s, end_s);
    write(book.steps[i].wait, free_s, step.begin_s);
    free_s = step.end_s;
  }

  Reservation& rest = reservations_[book.rest];
  rest.step = agent.beyond();
  rest.from_s = free_s;
  rest.to_s = kForEver;
  rest.is_frozen = agent.is_frozen;
}

// ---- Trials ----

void Timetable::save_tail(const Agent& agent) {
  if (!is_trial_ || saved_.count(agent.number) > 0) return;
  saved_[agent.number] = {{agent.steps.begin() + static_cast<std::ptrdiff_t>(agent.pending()), agent.steps.end()},
                          agent.has_plan_to_goal};
}

void Timetable::begin_trial() {
  is_trial_ = true;
  saved_.clear();
}

void Timetable::keep_trial() {
  is_trial_ = false;
  saved_.clear();
}

void Timetable::undo_trial() {
  is_trial_ = false;

  // First all end, so that no tail is linked by its old times to another's new ones.
  for (auto& [number, tail] : saved_) set_tail(*by_number_[number], {});
  for (auto& [number, tail] : saved_) {
    set_tail(*by_number_[number], std::move(tail.steps));
    by_number_[number]->has_plan_to_goal = tail.has_plan_to_goal;
  }
  saved_.clear();
}

}  // namespace aisle::global_planner::traffic
