// What stands on the floor closes places and motions of the roadmap for a time.
#include <algorithm>

#include "services/global-planner/core/traffic/roadmap.hpp"

namespace aisle::global_planner::traffic {

void Roadmap::close_place(PlaceId id, Closure& closure) {
  Place& place = *places_[id];
  if (!meet(place.standing, closure.shape, gap_m_)) return;

  ++place_closed_by_[id];
  place.is_closed = true;
  closure.places.push_back(id);
}

void Roadmap::close_motion(MotionId id, Closure& closure) {
  Motion& motion = *motions_[id];
  if (!meet(motion.shape, closure.shape, gap_m_)) return;

  // Out of a place that is closed by the same thing, and away from it: never nearer than where the vehicle stands.
  const double from_m = separation_m(places_[motion.from]->standing, closure.shape);
  const bool leads_away = from_m < gap_m_ && separation_m(motion.shape, closure.shape) > from_m - 1e-6 &&
                          separation_m(places_[motion.to]->standing, closure.shape) > from_m + 1e-6;
  if (leads_away) return;

  ++motion_closed_by_[id];
  motion.is_closed = true;
  closure.motions.push_back(id);
}

void Roadmap::close(const std::string& name, const Shape& shape) {
  open(name);
  if (shape.empty()) return;

  Closure& closure = closures_[name];
  closure.shape = shape;
  const Box around = grown(shape.box(), gap_m_);
  place_shapes_.visit(around, [&](PlaceId id) { close_place(id, closure); });
  motion_shapes_.visit(around, [&](MotionId id) { close_motion(id, closure); });
  closures_changed();
}

void Roadmap::open(const std::string& name) {
  const auto closure = closures_.find(name);
  if (closure == closures_.end()) return;

  for (const PlaceId id : closure->second.places)
    if (--place_closed_by_[id] == 0 && places_[id]) places_[id]->is_closed = false;
  for (const MotionId id : closure->second.motions)
    if (--motion_closed_by_[id] == 0 && motions_[id]) motions_[id]->is_closed = false;

  closures_.erase(closure);
  closures_changed();
}

void Roadmap::closures_changed() {
  ++revision_;
  seconds_to_.clear();
}

}  // namespace aisle::global_planner::traffic
