// What stands on the floor closes places and motions of the roadmap for a time.
#include <algorithm>
#include <cmath>

#include "services/global-planner/core/traffic/roadmap.hpp"

namespace aisle::global_planner::traffic {
namespace {

constexpr double kNearM = 6.0;   // between things whose ways round may touch
constexpr double kWindow = 4.0;  // pitches round a thing that are looked at for a way past it

bool are_alike(const Shape& a, const Shape& b) {
  constexpr double kAlikeM = 0.01;
  const auto alike = [](const Capsule& x, const Capsule& y) {
    return distance(x.from_in_map, y.from_in_map) < kAlikeM && distance(x.to_in_map, y.to_in_map) < kAlikeM &&
           std::abs(x.radius_m - y.radius_m) < kAlikeM;
  };
  return std::equal(a.capsules().begin(), a.capsules().end(), b.capsules().begin(), b.capsules().end(), alike);
}

/// The cells of the window as a map of its own; outside the map nothing is free.
grid::OccupancyGrid cut_out(const grid::ClearanceField& clearance, const Box& window) {
  const grid::Geometry& whole = clearance.geometry();
  const grid::Cell low = whole.cell_at(window.low_in_map);
  const grid::Cell high = whole.cell_at(window.high_in_map);
  const geometry::Point2 corner =
      whole.center_in_map(low) - geometry::Point2{0.5 * whole.resolution_m, 0.5 * whole.resolution_m};

  grid::OccupancyGrid out({high.x - low.x + 1, high.y - low.y + 1, whole.resolution_m, corner});
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x)
      if (clearance.clearance_m(grid::Cell{x, y}) <= 0.0) out.set({x - low.x, y - low.y}, grid::Occupancy::kOccupied);

  return out;
}

/// Marks all cells that the shape, wider by `wider_m`, touches.
void stamp(const Shape& shape, double wider_m, grid::OccupancyGrid& grid) {
  const grid::Geometry& geometry = grid.geometry();
  const double reach_m = wider_m + 0.7072 * geometry.resolution_m;  // half a cell's diagonal
  const Box around = grown(shape.box(), reach_m);
  const grid::Cell low = geometry.cell_at(around.low_in_map);
  const grid::Cell high = geometry.cell_at(around.high_in_map);

  for (int y = std::max(0, low.y); y <= std::min(high.y, geometry.height - 1); ++y) {
    for (int x = std::max(0, low.x); x <= std::min(high.x, geometry.width - 1); ++x) {
      const geometry::Point2 centre = geometry.center_in_map({x, y});
      const bool is_touched = std::any_of(shape.capsules().begin(), shape.capsules().end(), [&](const Capsule& c) {
        return geometry::distance_to_segment(centre, c.from_in_map, c.to_in_map) < c.radius_m + reach_m;
      });
      if (is_touched) grid.set({x, y}, grid::Occupancy::kOccupied);
    }
  }
}

}  // namespace

void Roadmap::close_place(PlaceId id, Closure& closure) {
  Place& place = *places_[id];
  if (!meet(place.standing, closure.shape, gap_m_)) return;

  ++place_closed_by_[id];
  place.is_closed = true;
  closure.closed.places.push_back(id);
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
  motion.is_closed = motion.is_blocked = true;
  closure.closed.motions.push_back(id);
}

/// How: on a cut-out of the map in which all that stands is occupied, the places and motions near are made as on any
/// map, beside those that are open. What stands is widened there so that what is made keeps `gap_m_` from it.
void Roadmap::make_room(Closure& closure) {
  if (clearance_ == nullptr) return;

  for (KindId kind = 0; kind < nets_.size(); ++kind) {
    const Net& net = nets_[kind];
    if (!net.kind.turns_on_the_spot()) continue;

    const Box region = grown(closure.shape.box(), net.spec.need_m + net.spec.pitch_m);
    const Box window = grown(region, kWindow * net.spec.pitch_m);
    const double wider_m = std::max(0.0, net.kind.tube_m + gap_m_ - net.kind.wall_margin_m);

    grid::OccupancyGrid floor = cut_out(*clearance_, window);
    for (const auto& other : closures_)
      if (touch(other.second.shape.box(), window)) stamp(other.second.shape, wider_m, floor);

    const Ids made = make_turning_places(kind, {grid::ClearanceField(floor), region, window, false});
    closure.made.places.insert(closure.made.places.end(), made.places.begin(), made.places.end());
    closure.made.motions.insert(closure.made.motions.end(), made.motions.begin(), made.motions.end());
  }
}

void Roadmap::close(const std::string& name, const Shape& shape) {
  const auto known = closures_.find(name);
  if (known != closures_.end() && are_alike(known->second.shape, shape)) return;

  open(name);
  if (shape.empty()) return;

  Closure& closure = closures_[name];
  closure.shape = shape;
  const Box around = grown(shape.box(), gap_m_);
  place_shapes_.visit(around, [&](PlaceId id) { close_place(id, closure); });
  motion_shapes_.visit(around, [&](MotionId id) { close_motion(id, closure); });
  make_room(closure);
  closures_changed();
}

void Roadmap::open(const std::string& name) {
  const auto closure = closures_.find(name);
  if (closure == closures_.end()) return;

  for (const PlaceId id : closure->second.closed.places)
    if (--place_closed_by_[id] == 0 && places_[id]) places_[id]->is_closed = false;
  for (const MotionId id : closure->second.closed.motions)
    if (--motion_closed_by_[id] == 0 && motions_[id]) motions_[id]->is_closed = motions_[id]->is_blocked = false;
  for (const PlaceId id : closure->second.made.places)
    if (places_[id]) retire(id);
  for (const MotionId id : closure->second.made.motions)
    if (motions_[id]) retire_motion(id);

  // What was made round others near may have hung on what ends now.
  const Box shape_box = closure->second.shape.box();
  closures_.erase(closure);
  for (auto& other : closures_)
    if (touch(other.second.shape.box(), grown(shape_box, kNearM))) make_room(other.second);
  closures_changed();
}

void Roadmap::closures_changed() {
  for (KindId kind = 0; kind < nets_.size(); ++kind) find_corridors(kind);
  ++revision_;
  seconds_to_.clear();
}

}  // namespace aisle::global_planner::traffic
