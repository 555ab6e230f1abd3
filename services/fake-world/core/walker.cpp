#include "services/fake-world/core/walker.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::fake_world {

using geometry::Point2;

namespace {

/// Least distance in metres from the origin within the next `for_s` seconds, of a point that is at `offset` now and
/// moves by `velocity`.
double least_distance_m(Point2 offset, Point2 velocity, double for_s) {
  const double speed2 = geometry::dot(velocity, velocity);
  const double t_s = speed2 > 0.0 ? std::clamp(-geometry::dot(offset, velocity) / speed2, 0.0, for_s) : 0.0;

  return geometry::norm(offset + t_s * velocity);
}

}  // namespace

Walker::Walker(const scenario::Mover& mover, const Progress& progress) : mover_(mover), progress_(progress) {
  // Length along the way from the first waypoint to each one.
  lengths_m_.push_back(0.0);

  for (std::size_t i = 1; i < mover_.waypoints_in_map.size(); ++i) {
    lengths_m_.push_back(lengths_m_.back() +
                         geometry::distance(mover_.waypoints_in_map[i - 1], mover_.waypoints_in_map[i]));
  }

  progress_.along_m = std::clamp(progress_.along_m, 0.0, length_m());
}

void Walker::step(double dt_s, const std::vector<geometry::Body>& vehicles, const std::vector<Neighbour>& persons) {
  const bool at_the_end = !mover_.loop && progress_.along_m >= length_m();
  const bool is_blocked =
      (mover_.courteous && must_wait(vehicles)) ||
      std::any_of(persons.begin(), persons.end(), [&](const Neighbour& person) { return must_let_pass(person); });

  walks_ = !at_the_end && length_m() > 0.0 && !is_blocked;

  // Walking resets the patience; a walker that loops and has waited too long turns back.
  if (walks_) {
    progress_.waited_s = 0.0;
    walk(mover_.speed_mps * dt_s);
    return;
  }

  if (at_the_end) return;

  progress_.waited_s += dt_s;

  if (mover_.loop && progress_.waited_s > kPatienceS) {
    progress_.back = !progress_.back;
    progress_.waited_s = 0.0;
  }
}

void Walker::walk(double distance_m) {
  progress_.along_m += progress_.back ? -distance_m : distance_m;

  if (!mover_.loop) {
    progress_.along_m = std::min(progress_.along_m, length_m());
    return;
  }

  // To and fro: what leads beyond an end is walked back from it.
  if (progress_.along_m > length_m()) {
    progress_.along_m = std::max(0.0, 2.0 * length_m() - progress_.along_m);
    progress_.back = true;
  } else if (progress_.along_m < 0.0) {
    progress_.along_m = std::min(length_m(), -progress_.along_m);
    progress_.back = false;
  }
}

std::size_t Walker::segment() const {
  const auto end = std::upper_bound(lengths_m_.begin(), lengths_m_.end(), progress_.along_m);
  const auto index = static_cast<std::size_t>(end - lengths_m_.begin());
  return std::clamp<std::size_t>(index, 1, lengths_m_.size() - 1) - 1;
}

Point2 Walker::position_in_map() const {
  // p = a + share (b - a), share: the part of the segment that is walked.
  const std::size_t i = segment();
  const double segment_m = lengths_m_[i + 1] - lengths_m_[i];
  const double share = segment_m > 0.0 ? (progress_.along_m - lengths_m_[i]) / segment_m : 0.0;

  const Point2 a = mover_.waypoints_in_map[i];

  return a + share * (mover_.waypoints_in_map[i + 1] - a);
}

Point2 Walker::direction_in_map() const {
  const std::size_t i = segment();
  const Point2 way = mover_.waypoints_in_map[i + 1] - mover_.waypoints_in_map[i];
  const double length = geometry::norm(way);
  if (length <= 0.0) return {};

  return (progress_.back ? -1.0 : 1.0) / length * way;
}

bool Walker::must_wait(const std::vector<geometry::Body>& vehicles) const {
  const Point2 here = position_in_map();
  const Point2 ahead = direction_in_map();

  // A vehicle is in the way when it is near and ahead: (vehicle - here) . direction > 0.
  return std::any_of(vehicles.begin(), vehicles.end(), [&](const geometry::Body& vehicle) {
    const bool is_near = geometry::distance_m(vehicle, here) < mover_.radius_m + kCourtesyM;
    return is_near && geometry::dot(ahead, vehicle.base_in_map.position() - here) > 0.0;
  });
}

bool Walker::must_let_pass(const Neighbour& person) const {
  const Point2 offset = person.position_in_map - position_in_map();
  const double apart_m = mover_.radius_m + person.radius_m + kPersonGapM;

  // Close by and ahead: each step would lead nearer.
  const Point2 ahead = direction_in_map();
  if (geometry::norm(offset) < apart_m) return geometry::dot(ahead, offset) > 0.0;

  // One that goes first is let pass where walking on would lead into it, and standing here does not.
  if (!person.goes_first) return false;

  const Point2 seen_walking = person.velocity_in_map - mover_.speed_mps * ahead;
  return least_distance_m(offset, seen_walking, kForesightS) < apart_m &&
         least_distance_m(offset, person.velocity_in_map, kForesightS) >= apart_m;
}

Motion Walker::motion() const { return {position_in_map(), walks_ ? mover_.speed_mps * direction_in_map() : Point2{}}; }

}  // namespace aisle::fake_world
