#include "services/global-planner/core/traffic/reservations.hpp"

#include <algorithm>

namespace aisle::global_planner::traffic {
namespace {

constexpr std::size_t kMostUnused = 256;  // shapes that are remembered though nothing reserves them
constexpr std::size_t kMostEnded = 8192;  // shapes that keep their numbers though they have ended

}  // namespace

ReservationId Reservations::add(const Reservation& reservation) {
  ReservationId id = static_cast<ReservationId>(all_.size());
  if (free_.empty()) {
    all_.push_back(reservation);
  } else {
    id = free_.back();
    free_.pop_back();
    all_[id] = reservation;
  }

  const ShapeId shape = reservation.shape;
  if (shape >= of_shape_.size()) {
    of_shape_.resize(meetings_.shapes());
    noted_.resize(meetings_.shapes(), 0);
  }
  if (of_shape_[shape].empty()) {
    ++shapes_in_use_;
    note_reserved(shape);
  }
  of_shape_[shape].push_back(id);
  return id;
}

void Reservations::remove(ReservationId id) {
  auto& same_shape = of_shape_[all_[id].shape];
  same_shape.erase(std::find(same_shape.begin(), same_shape.end(), id));
  if (same_shape.empty()) --shapes_in_use_;
  free_.push_back(id);
}

void Reservations::note_reserved(ShapeId shape) {
  if (noted_[shape] == epoch_) return;

  if (reserved_.size() > kMostUnused + 2 * shapes_in_use_) begin_epoch();
  noted_[shape] = epoch_;
  reserved_.push_back({shape, meetings_.box(shape)});
  bins_.add(meetings_.box(shape), shape);
}

void Reservations::begin_epoch() {
  ++epoch_;
  std::vector<Reserved> before;
  before.swap(reserved_);
  bins_.clear();
  for (const Reserved& entry : before) {
    if (of_shape_[entry.shape].empty()) continue;
    noted_[entry.shape] = epoch_;
    reserved_.push_back(entry);
    bins_.add(entry.box, entry.shape);
  }
}

void Reservations::tidy_up() {
  if (meetings_.ended() < kMostEnded) return;

  std::vector<bool> is_used(meetings_.shapes(), false);
  for (ShapeId shape = 0; shape < of_shape_.size(); ++shape) is_used[shape] = !of_shape_[shape].empty();
  begin_epoch();
  meetings_.reuse_ended(is_used);
}

/// How: at the first time in an epoch all reserved shapes near are judged, later those that have been reserved since.
const std::vector<ShapeId>& Reservations::met_by(ShapeId shape) const {
  if (shape >= near_.size()) near_.resize(meetings_.shapes());
  Near& near = near_[shape];
  const Box box = grown(meetings_.box(shape), meetings_.gap_m());
  const auto judge = [&](ShapeId other) {
    if (other == shape || meet(meetings_.shape(shape), meetings_.shape(other), meetings_.gap_m()))
      near.met.push_back(other);
  };

  if (near.epoch != epoch_) {
    near.epoch = epoch_;
    near.met.clear();
    bins_.visit(box, judge);
  } else {
    for (std::size_t i = near.judged; i < reserved_.size(); ++i)
      if (touch(box, reserved_[i].box)) judge(reserved_[i].shape);
  }
  near.judged = reserved_.size();
  return near.met;
}

Interval Reservations::counted(const Reservation& r, const View& view) {
  if (r.agent == view.agent) return {};
  if (r.is_frozen) return {r.from_s, r.to_s};

  if (r.use != Reservation::Use::kRest)
    return r.is_granted || !view.granted_only ? Interval{r.from_s, r.to_s} : Interval{};

  if (view.granted_only) return {};
  const double soft_end_s = std::max(r.from_s, view.now_s) + view.soft_rest_s;
  return {r.from_s, std::min(r.to_s, soft_end_s)};
}

void Reservations::merge(Intervals& intervals, double merge_s) {
  std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) {
    return a.from_s != b.from_s ? a.from_s < b.from_s : a.to_s < b.to_s;
  });

  std::size_t kept = 0;
  for (const Interval& next : intervals) {
    if (kept > 0 && next.from_s < intervals[kept - 1].to_s + merge_s)
      intervals[kept - 1].to_s = std::max(intervals[kept - 1].to_s, next.to_s);
    else
      intervals[kept++] = next;
  }
  intervals.resize(kept);
}

void Reservations::busy(ShapeId shape, const View& view, Intervals& out) const {
  out.clear();
  visit_meeting(shape, [&](const Reservation& reservation) {
    const Interval taken = counted(reservation, view);
    if (taken.to_s > taken.from_s) out.push_back(taken);
  });
  merge(out, merge_s_);
}

}  // namespace aisle::global_planner::traffic
