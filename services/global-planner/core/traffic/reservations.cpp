#include "services/global-planner/core/traffic/reservations.hpp"

#include <algorithm>

namespace aisle::global_planner::traffic {

ReservationId Reservations::add(const Reservation& reservation) {
  ReservationId id = static_cast<ReservationId>(all_.size());
  if (free_.empty()) {
    all_.push_back(reservation);
  } else {
    id = free_.back();
    free_.pop_back();
    all_[id] = reservation;
  }

  if (reservation.shape >= of_shape_.size()) of_shape_.resize(meetings_.shapes());
  auto& same_shape = of_shape_[reservation.shape];
  if (same_shape.empty()) bins_.add(meetings_.box(reservation.shape), reservation.shape);
  same_shape.push_back(id);
  return id;
}

void Reservations::remove(ReservationId id) {
  const ShapeId shape = all_[id].shape;
  auto& same_shape = of_shape_[shape];
  same_shape.erase(std::find(same_shape.begin(), same_shape.end(), id));
  if (same_shape.empty()) bins_.remove(meetings_.box(shape), shape);
  free_.push_back(id);
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
