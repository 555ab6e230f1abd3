#include "services/global-planner/core/traffic/space_time_search.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::global_planner::traffic {
namespace {

constexpr std::uint32_t kHeadings = 8;

// States that are expanded at most: so many, and these for each second that the vehicle takes alone. Ways that exist
// take far fewer; what is tried in vain ends sooner.
constexpr double kFewExpanded = 2'500.0;
constexpr double kExpandedPerS = 50.0;

// Times that differ by less are equal.
constexpr double kRoundingS = 1e-9;

std::uint32_t heading_number(double heading_rad) {
  const double eighths = std::round(heading_rad / (geometry::kPi / 4.0));
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(eighths) & 7);
}

}  // namespace

bool SpaceTimeSearch::may_drive(const Motion& motion, const Place& from, const Place& to) {
  if (motion.is_blocked) return false;
  if (motion.is_closed) return from.is_closed && from.is_temporary && !to.is_closed;
  return !to.is_closed || from.is_closed;
}

void SpaceTimeSearch::begin(const View& view) {
  view_ = view;
  ++search_;
  nodes_.clear();
  open_.clear();
  free_.clear();
  busy_.clear();
  visited_.clear();
  if (places_.size() < roadmap_.places()) places_.resize(roadmap_.places());
}

/// Writes the gaps between the taken times as the place's free intervals.
SpaceTimeSearch::PlaceNotes& SpaceTimeSearch::write_free(PlaceId place, const Intervals& taken) {
  PlaceNotes& notes = places_[place];
  notes.search = search_;
  notes.first = static_cast<std::uint32_t>(free_.size());

  double from_s = -kForEver;
  for (const Interval& interval : taken) {
    if (interval.from_s > from_s) free_.push_back({from_s, interval.from_s});
    from_s = interval.to_s;
  }
  if (from_s < kForEver) free_.push_back({from_s, kForEver});

  notes.count = static_cast<std::uint32_t>(free_.size()) - notes.first;
  notes.visited = static_cast<std::uint32_t>(visited_.size());
  visited_.resize(visited_.size() + static_cast<std::size_t>(notes.count) * kHeadings, kForEver);
  return notes;
}

const SpaceTimeSearch::PlaceNotes& SpaceTimeSearch::notes_of(PlaceId place) {
  PlaceNotes& notes = places_[place];
  if (notes.search == search_) return notes;

  reservations_.busy(meetings_.of_place(place), view_, scratch_);
  return write_free(place, scratch_);
}

/// The vehicle stands there, whoever else has taken the place at that time: it is free until somebody comes later.
const SpaceTimeSearch::PlaceNotes& SpaceTimeSearch::notes_of_start(PlaceId place, double time_s) {
  scratch_.clear();
  reservations_.visit_meeting(meetings_.of_place(place), [&](const Reservation& reservation) {
    const Interval taken = Reservations::counted(reservation, view_);
    if (taken.to_s > taken.from_s && taken.from_s > time_s) scratch_.push_back(taken);
  });
  Reservations::merge(scratch_, settings_.merge_s);
  return write_free(place, scratch_);
}

const SpaceTimeSearch::ShapeNotes& SpaceTimeSearch::notes_of_shape(ShapeId shape) {
  if (shape >= shapes_.size()) shapes_.resize(std::max<std::size_t>(meetings_.shapes(), shape + 1));
  ShapeNotes& notes = shapes_[shape];
  if (notes.search == search_) return notes;

  reservations_.busy(shape, view_, scratch_);
  notes.search = search_;
  notes.first = static_cast<std::uint32_t>(busy_.size());
  notes.count = static_cast<std::uint32_t>(scratch_.size());
  busy_.insert(busy_.end(), scratch_.begin(), scratch_.end());
  return notes;
}

/// The earliest time from `from_s` on at which the shape is free for `run_s`.
double SpaceTimeSearch::earliest(ShapeId shape, double from_s, double run_s) {
  const ShapeNotes notes = notes_of_shape(shape);
  for (std::uint32_t i = notes.first; i < notes.first + notes.count; ++i) {
    if (from_s + run_s <= busy_[i].from_s) break;
    from_s = std::max(from_s, busy_[i].to_s);
  }
  return from_s;
}

/// The earliest time from `from_s` on at which no other vehicle rests in the corridor that the motion enters.
double SpaceTimeSearch::earliest_into_corridor(const Motion& motion, double from_s) const {
  if (corridor_rests_ == nullptr || corridor_rests_->empty()) return from_s;
  const std::uint32_t corridor = roadmap_.place(motion.to).corridor;
  if (corridor == kNoId || roadmap_.place(motion.from).corridor == corridor) return from_s;

  const auto found = corridor_rests_->find(corridor);
  if (found == corridor_rests_->end()) return from_s;

  for (const ReservationId id : found->second) {
    const Interval taken = Reservations::counted(reservations_[id], view_);
    if (taken.from_s <= from_s && from_s < taken.to_s) from_s = taken.to_s;
  }
  return from_s;
}

/// The earliest time from `from_s` on at which the corner into the motion is free for `run_s`.
///
/// How: a place has many corners, and the floor that holds all of them is free most of the time: it is looked at first.
double SpaceTimeSearch::earliest_corner(const Node& from, MotionId motion, double from_s, double run_s) {
  if (from.by == kNoId) return from_s;

  if (!roadmap_.place(from.place).is_temporary) {
    const ShapeId all = meetings_.of_all_corners(from.place);
    if (all == kNoId || earliest(all, from_s, run_s) == from_s) return from_s;
  }

  const ShapeId corner = meetings_.of_corner(from.by, motion);
  return corner == kNoId ? from_s : earliest(corner, from_s, run_s);
}

/// The earliest departure from `from_s` on at which the motion, its corner and its corridor are free.
double SpaceTimeSearch::earliest_departure(const Node& from, MotionId id, double from_s, double run_s) {
  const Motion& motion = roadmap_.motion(id);
  const ShapeId shape = meetings_.of_motion(id);

  double departure_s = from_s;
  while (departure_s < kForEver) {
    const double before_s = departure_s;
    departure_s = earliest(shape, departure_s, run_s);
    departure_s = earliest_corner(from, id, departure_s, run_s);
    departure_s = earliest_into_corridor(motion, departure_s);
    if (departure_s <= before_s) break;
  }
  return departure_s;
}

void SpaceTimeSearch::push(Node node, double to_go_s) {
  double& best_s = visited_[places_[node.place].visited + node.interval * kHeadings + heading_number(node.heading_rad)];
  if (node.time_s >= best_s) return;
  best_s = node.time_s;

  const auto later = [](const Open& a, const Open& b) {
    if (a.order_s != b.order_s) return a.order_s > b.order_s;
    return a.time_s != b.time_s ? a.time_s < b.time_s : a.node > b.node;
  };
  open_.push_back(
      {node.time_s + settings_.heuristic_weight * to_go_s, node.time_s, static_cast<std::uint32_t>(nodes_.size())});
  std::push_heap(open_.begin(), open_.end(), later);
  nodes_.push_back(node);
}

/// Arrivals by one motion: one in each free interval of its place that can be reached.
void SpaceTimeSearch::try_motion(std::uint32_t from_number, MotionId id, double to_go_s) {
  const Node from = nodes_[from_number];
  const Motion& motion = roadmap_.motion(id);
  const Kind& kind = roadmap_.kind(motion.kind);
  const double left_free_until_s = free_[places_[from.place].first + from.interval].to_s;
  const PlaceNotes to = notes_of(motion.to);

  const double moving_run_s = run_s(kind, motion, from.heading_rad, from.is_standing);
  for (std::uint32_t i = 0; i < to.count; ++i) {
    const Interval free = free_[to.first + i];
    if (free.to_s < from.time_s + moving_run_s) continue;
    if (free.from_s > left_free_until_s + moving_run_s) break;

    // Nothing is looked up for what comes no sooner than what is known.
    double run = moving_run_s;
    const double ready_s = std::max(from.time_s, free.from_s - run);
    if (ready_s + run >= visited_[to.visited + i * kHeadings + heading_number(motion.exit_rad)]) continue;

    double departure_s = earliest_departure(from, id, ready_s, run);
    if (departure_s > from.time_s + kRoundingS && !from.is_standing) {
      run = run_s(kind, motion, from.heading_rad, true);
      departure_s = earliest_departure(from, id, departure_s, run);
    }
    if (departure_s > left_free_until_s) break;
    if (departure_s + run > free.to_s) continue;

    push({motion.to, i, departure_s + run, motion.exit_rad, id, departure_s, from_number, false}, to_go_s);
  }
}

/// Seconds alone to the goal; from a temporary place by the best of its motions.
double SpaceTimeSearch::to_go_s(PlaceId place, const std::vector<double>* alone_s) const {
  if (alone_s == nullptr || place == goal_) return 0.0;

  const Place& here = roadmap_.place(place);
  if (!here.is_temporary && !here.is_closed) return place < alone_s->size() ? (*alone_s)[place] : kForEver;

  double best_s = kForEver;
  for (const MotionId id : here.leaving) {
    const Motion& motion = roadmap_.motion(id);
    if (!may_drive(motion, here, roadmap_.place(motion.to))) continue;
    const double rest_s = motion.to == goal_ ? 0.0 : motion.to < alone_s->size() ? (*alone_s)[motion.to] : kForEver;
    best_s = std::min(best_s, run_s(roadmap_.kind(motion.kind), motion, motion.entry_rad, false) + rest_s);
  }
  return best_s;
}

double SpaceTimeSearch::alone_s(PlaceId from, PlaceId goal) {
  goal_ = goal;
  return to_go_s(from, &roadmap_.seconds_to(goal));
}

bool SpaceTimeSearch::is_end(const Node& node, const Destination& to) const {
  if (free_[places_[node.place].first + node.interval].to_s < kForEver) return false;
  return to.place != kNoId ? node.place == to.place : to.is_rest(node.place);
}

std::vector<Leg> SpaceTimeSearch::legs_to(std::uint32_t node) const {
  std::vector<Leg> legs;
  for (; nodes_[node].parent != kNoId; node = nodes_[node].parent)
    legs.push_back({nodes_[node].by, nodes_[node].left_s, nodes_[node].time_s});
  std::reverse(legs.begin(), legs.end());
  return legs;
}

void SpaceTimeSearch::expand(std::uint32_t number, const std::vector<double>* alone_s) {
  const PlaceId place = nodes_[number].place;
  const Place& here = roadmap_.place(place);
  for (const MotionId id : here.leaving) {
    const Motion& motion = roadmap_.motion(id);
    if (!may_drive(motion, here, roadmap_.place(motion.to))) continue;

    const double left_s = to_go_s(motion.to, alone_s);
    if (left_s < kForEver) try_motion(number, id, left_s);
  }
}

std::optional<std::vector<Leg>> SpaceTimeSearch::find(const Departure& from, const Destination& to, const View& view) {
  goal_ = to.place;
  const std::vector<double>* alone_s = to.place == kNoId ? nullptr : &roadmap_.seconds_to(to.place);
  const double first_to_go_s = to_go_s(from.place, alone_s);
  if (first_to_go_s == kForEver || (to.place != kNoId && !gets_free(to.place, view))) return std::nullopt;

  begin(view);
  notes_of_start(from.place, from.time_s);
  push({from.place, 0, from.time_s, from.heading_rad, from.before, 0.0, kNoId, from.is_standing}, first_to_go_s);

  const auto later = [](const Open& a, const Open& b) {
    if (a.order_s != b.order_s) return a.order_s > b.order_s;
    return a.time_s != b.time_s ? a.time_s < b.time_s : a.node > b.node;
  };
  const double budget = kFewExpanded + (to.place == kNoId ? 0.0 : kExpandedPerS * first_to_go_s);
  const std::size_t most_expanded = std::min(settings_.most_expanded, static_cast<std::size_t>(budget));
  for (std::size_t expanded = 0; !open_.empty() && expanded < most_expanded; ++expanded) {
    std::pop_heap(open_.begin(), open_.end(), later);
    const std::uint32_t number = open_.back().node;
    open_.pop_back();

    const Node& node = nodes_[number];
    const std::uint32_t state = places_[node.place].visited + node.interval * kHeadings;
    if (node.time_s > visited_[state + heading_number(node.heading_rad)]) continue;
    if (is_end(node, to)) return legs_to(number);

    ++expanded_;
    expand(number, alone_s);
  }
  return std::nullopt;
}

/// How: the same states as in find(), one motion after the other; all arrivals at a cut, one in each free interval, are
/// carried on to the next.
std::optional<std::vector<Leg>> SpaceTimeSearch::time(const Departure& from, const std::vector<MotionId>& motions,
                                                      const View& view) {
  goal_ = kNoId;
  begin(view);
  notes_of_start(from.place, from.time_s);
  push({from.place, 0, from.time_s, from.heading_rad, from.before, 0.0, kNoId, from.is_standing}, 0.0);

  std::uint32_t first = 0;
  for (const MotionId id : motions) {
    const Motion& motion = roadmap_.motion(id);
    const std::uint32_t last = static_cast<std::uint32_t>(nodes_.size());
    if (motion.from != nodes_[first].place ||
        !may_drive(motion, roadmap_.place(motion.from), roadmap_.place(motion.to)))
      return std::nullopt;

    for (std::uint32_t number = first; number < last; ++number) try_motion(number, id, 0.0);
    if (nodes_.size() == last) return std::nullopt;
    first = last;
  }

  for (std::uint32_t number = first; number < nodes_.size(); ++number) {
    const Node& node = nodes_[number];
    if (free_[places_[node.place].first + node.interval].to_s == kForEver) return legs_to(number);
  }
  return std::nullopt;
}

bool SpaceTimeSearch::is_free_for_ever(PlaceId place, double from_s, const View& view) {
  reservations_.busy(meetings_.of_place(place), view, scratch_);
  return scratch_.empty() || scratch_.back().to_s <= from_s;
}

bool SpaceTimeSearch::gets_free(PlaceId place, const View& view) {
  reservations_.busy(meetings_.of_place(place), view, scratch_);
  return scratch_.empty() || scratch_.back().to_s < kForEver;
}

}  // namespace aisle::global_planner::traffic
