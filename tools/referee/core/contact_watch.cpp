#include "tools/referee/core/contact_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace aisle::referee {
namespace {

using geometry::Pose2;

constexpr double kTouch_m = 1e-9;

/// Two samples that are closer in time than this say nothing about speed.
constexpr double kShortest_s = 0.005;

/// Of a vehicle and a body of this kind.
PairClass class_of(BodyKind other) {
  switch (other) {
    case BodyKind::kVehicle:
      return PairClass::kVehicleVehicle;
    case BodyKind::kPerson:
      return PairClass::kVehiclePerson;
    case BodyKind::kBlock:
      break;
  }

  return PairClass::kVehicleBlock;
}

}  // namespace

Pose2 middle_in_map(const Pose2& base_in_map, double ahead_m) {
  const geometry::Point2 middle = geometry::to_map(base_in_map, {ahead_m, 0.0});
  return {middle.x, middle.y, base_in_map.yaw};
}

const char* name_of(PairClass pair) {
  switch (pair) {
    case PairClass::kVehicleVehicle:
      return "vehicle_vehicle";
    case PairClass::kVehiclePerson:
      return "vehicle_person";
    case PairClass::kVehicleBlock:
      return "vehicle_block";
    case PairClass::kVehicleWall:
      break;
  }

  return "vehicle_wall";
}

std::optional<double> Clearances::overall_m() const {
  std::optional<double> least;
  for (const std::optional<double>& one : least_m) {
    if (one && (!least || *one < *least)) least = one;
  }

  return least;
}

ContactWatch::ContactWatch(const Walls* walls) : walls_(walls) {}

/// A sample that comes after its moment was judged counts from that moment on: time does not go back.
void ContactWatch::see(const BodySample& sample) {
  const auto [found, is_new] =
      bodies_.try_emplace(sample.id, Body{sample.kind, sample.shape, sample.boot_id, {}, sample.t_s});
  Body& body = found->second;

  if (body.boot_id != sample.boot_id) {
    body = Body{sample.kind, sample.shape, sample.boot_id, {}, sample.t_s};
  } else if (!is_new && sample.t_s <= body.last_seen_s) {
    return;
  }

  body.shape = sample.shape;
  body.last_seen_s = sample.t_s;

  if (!body.knots.empty() && body.knots.back().t_s < judged_until_s_) {  // it was judged to stand there until now
    body.knots.push_back({judged_until_s_, body.knots.back().pose, body.knots.back().speed_mps});
  }

  const double not_before_s =
      body.knots.empty() ? judged_until_s_ : std::max(judged_until_s_, body.knots.back().t_s) + 1e-9;
  body.knots.push_back(
      {std::max(sample.t_s, not_before_s), middle_in_map(sample.base_in_map, sample.ahead_m), sample.speed_mps});
}

void ContactWatch::gone(const std::string& id) { bodies_.erase(id); }

/// Every pair with a vehicle in it, and every vehicle with the walls.
void ContactWatch::advance(double until_s) {
  if (until_s <= judged_until_s_) return;

  for (auto a = bodies_.begin(); a != bodies_.end(); ++a) {
    if (a->second.kind == BodyKind::kVehicle && walls_ != nullptr) judge_walls(a->first, a->second, until_s);

    for (auto b = std::next(a); b != bodies_.end(); ++b) {
      const bool a_drives = a->second.kind == BodyKind::kVehicle;
      const bool b_drives = b->second.kind == BodyKind::kVehicle;

      if (a_drives) {
        judge_pair(a->first, a->second, b->first, b->second, until_s);
      } else if (b_drives) {
        judge_pair(b->first, b->second, a->first, a->second, until_s);
      }
    }
  }

  judged_until_s_ = until_s;
  forget(until_s);
}

/// Moments between which both move straight, from where both are known; less than two: nothing to judge yet.
std::vector<double> ContactWatch::breaks(const Body& a, const Body* b, double until_s) const {
  double begin_s = std::max(judged_until_s_, a.knots.front().t_s);
  if (b != nullptr) begin_s = std::max(begin_s, b->knots.front().t_s);

  std::vector<double> moments;
  if (begin_s > until_s) return moments;

  moments.push_back(begin_s);

  const auto collect = [&](const Body& body) {
    for (const Knot& knot : body.knots) {
      if (knot.t_s > begin_s && knot.t_s < until_s) moments.push_back(knot.t_s);
    }
  };

  collect(a);
  if (b != nullptr) collect(*b);
  moments.push_back(until_s);
  std::sort(moments.begin(), moments.end());

  return moments;
}

/// Interpolated between the two samples around the moment; before the first and after the last the body
/// stands.
ContactWatch::Knot ContactWatch::knot_at(const Body& body, double t_s) {
  const auto after = std::find_if(body.knots.begin(), body.knots.end(), [&](const Knot& k) { return k.t_s >= t_s; });
  if (after == body.knots.begin()) return body.knots.front();
  if (after == body.knots.end()) return body.knots.back();

  const Knot& from = *std::prev(after);
  const double share = (t_s - from.t_s) / (after->t_s - from.t_s);

  const Pose2 pose{from.pose.x + share * (after->pose.x - from.pose.x),
                   from.pose.y + share * (after->pose.y - from.pose.y),
                   geometry::wrap(from.pose.yaw + share * geometry::wrap(after->pose.yaw - from.pose.yaw))};

  return {t_s, pose, from.speed_mps + share * (after->speed_mps - from.speed_mps)};
}

/// A body's motion in one moment; its speed is the greater of what its samples say and what its places say, of a
/// rectangle that turns that of its corners.
ContactWatch::Piece ContactWatch::piece_of(const Body& body, const Moment& moment) {
  const Knot begin = knot_at(body, moment.begin_s);
  const Knot end = knot_at(body, moment.end_s);
  Piece piece{{body.shape, begin.pose, end.pose}, std::max(begin.speed_mps, end.speed_mps), 0.0, 0.0};
  const double dt_s = moment.end_s - moment.begin_s;

  // From the places; the corners of a rectangle that turns move as well.
  if (dt_s >= kShortest_s) {
    piece.velocity_x_mps = (end.pose.x - begin.pose.x) / dt_s;
    piece.velocity_y_mps = (end.pose.y - begin.pose.y) / dt_s;

    const double swing_m =
        body.shape.is_disc() ? 0.0 : body.shape.reach_m() * std::abs(geometry::wrap(end.pose.yaw - begin.pose.yaw));
    piece.speed_mps =
        std::max({piece.speed_mps, std::hypot(piece.velocity_x_mps, piece.velocity_y_mps), swing_m / dt_s});
  } else {
    const double way_m = geometry::distance(begin.pose.position(), end.pose.position());
    const geometry::Point2 along = way_m > 0.0 ? (1.0 / way_m) * (end.pose.position() - begin.pose.position())
                                               : geometry::Point2{std::cos(end.pose.yaw), std::sin(end.pose.yaw)};

    piece.velocity_x_mps = piece.speed_mps * along.x;
    piece.velocity_y_mps = piece.speed_mps * along.y;
  }

  return piece;
}

void ContactWatch::judge_pair(const std::string& id_a, const Body& a, const std::string& id_b, const Body& b,
                              double until_s) {
  const std::vector<double> moments = breaks(a, &b, until_s);
  for (std::size_t i = 1; i < moments.size(); ++i) {
    const Moment moment{moments[i - 1], moments[i]};
    const Piece piece_a = piece_of(a, moment);
    const Piece piece_b = piece_of(b, moment);
    note(class_of(b.kind), id_a, piece_a, id_b, &piece_b, moment, closest_approach(piece_a.motion, piece_b.motion));
  }
}

/// A vehicle that is far from all walls counts as at the end of the search.
void ContactWatch::judge_walls(const std::string& id, const Body& body, double until_s) {
  const std::vector<double> moments = breaks(body, nullptr, until_s);
  for (std::size_t i = 1; i < moments.size(); ++i) {
    const Moment moment{moments[i - 1], moments[i]};
    const Piece piece = piece_of(body, moment);
    const std::optional<Approach> approach = walls_->closest(piece.motion);

    note(PairClass::kVehicleWall, id, piece, "wall", nullptr, moment,
         approach.value_or(Approach{Walls::kSearch_m, 0.0}));
  }
}

/// A contact ends when the two have been more than kApart_m apart for kMerge_s.
void ContactWatch::note(PairClass pair, const std::string& id_a, const Piece& a, const std::string& id_b,
                        const Piece* b, const Moment& moment, const Approach& approach) {
  std::optional<double>& least = clearances_.least_m[static_cast<std::size_t>(pair)];
  if (!least || approach.clearance_m < *least) least = approach.clearance_m;

  std::optional<double>& of_moving = clearances_.moving_vehicle_m;
  if (fastest_vehicle_mps(pair, a, b) > kMovingMps && (!of_moving || approach.clearance_m < *of_moving))
    of_moving = approach.clearance_m;

  if (approach.clearance_m <= kTouch_m) {
    const double t_s = moment.begin_s + approach.at * (moment.end_s - moment.begin_s);
    note_touch(pair, id_a, a, id_b, b, t_s, -approach.clearance_m, approach.at);
  } else if (approach.clearance_m > kApart_m) {
    const auto touch = touches_.find({id_a, id_b});
    if (touch == touches_.end()) return;
    if (moment.end_s - touch->second.last_s > kMerge_s) touches_.erase(touch);
  }
}

double ContactWatch::fastest_vehicle_mps(PairClass pair, const Piece& a, const Piece* b) {
  return pair == PairClass::kVehicleVehicle ? std::max(a.speed_mps, b->speed_mps) : a.speed_mps;
}

/// The first touch gives the place; the worst of all touches the depth and the speeds.
void ContactWatch::note_touch(PairClass pair, const std::string& id_a, const Piece& a, const std::string& id_b,
                              const Piece* b, double t_s, double depth_m, double at) {
  auto touch = touches_.find({id_a, id_b});
  if (touch == touches_.end()) {
    const geometry::Point2 where =
        a.motion.begin.position() + at * (a.motion.end.position() - a.motion.begin.position());
    contacts_.push_back({pair, id_a, id_b, t_s, t_s, where, 0.0, 0.0, 0.0});
    touch = touches_.emplace(std::make_pair(id_a, id_b), Touch{contacts_.size() - 1, t_s}).first;
  }

  // It goes on: keep the worst of it.
  touch->second.last_s = t_s;

  Contact& contact = contacts_[touch->second.contact];
  contact.end_s = t_s;
  contact.depth_m = std::max(contact.depth_m, depth_m);

  const double other_x = b != nullptr ? b->velocity_x_mps : 0.0;
  const double other_y = b != nullptr ? b->velocity_y_mps : 0.0;

  contact.relative_speed_mps =
      std::max(contact.relative_speed_mps, std::hypot(a.velocity_x_mps - other_x, a.velocity_y_mps - other_y));

  contact.vehicle_speed_mps = std::max(contact.vehicle_speed_mps, fastest_vehicle_mps(pair, a, b));
}

void ContactWatch::forget(double until_s) {
  for (auto it = bodies_.begin(); it != bodies_.end();) {
    Body& body = it->second;
    while (body.knots.size() >= 2 && body.knots[1].t_s <= until_s) body.knots.pop_front();
    const bool silent = body.kind != BodyKind::kVehicle && until_s - body.last_seen_s > kMemory_s;
    it = silent ? bodies_.erase(it) : std::next(it);
  }
}

}  // namespace aisle::referee
