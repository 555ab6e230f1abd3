#include "tools/lab/traffic/kinematic_vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/geometry/separation.hpp"
#include "common/kinematics/vehicle_model.hpp"

namespace aisle::lab {
namespace {

using geometry::Point2;
using geometry::Pose2;
using global_planner::traffic::GrantedRoad;
using global_planner::traffic::HeldPose;
using global_planner::traffic::Kind;
using global_planner::traffic::Report;
using global_planner::traffic::Way;

constexpr double kAtM = 0.01;             // nearer than this to a point of the way: there
constexpr double kComfort = 0.7;          // share of the deceleration that is planned with
constexpr double kSharpestArcRad = 1.75;  // sharper corners are turned on the spot
constexpr double kStraightRad = 0.02;     // a corner of less is none
constexpr double kHeadingToleranceRad = 0.03;
constexpr double kSightM = 6.0;
constexpr double kKeptFromThingsM = 0.15;  // beside the outline
constexpr double kStopBeforeThingsM = 0.2;

}  // namespace

KinematicVehicle::KinematicVehicle(std::string agv_id, const Kind& kind, const Pose2& start_in_map)
    : agv_id_(std::move(agv_id)), kind_(kind), base_in_map_(start_in_map) {}

void KinematicVehicle::hear(const Way& way) {
  if (way_ && way.plan_id < way_->plan_id) return;

  heard_ways_[way.plan_id] = way;
  obey_newest();
}

void KinematicVehicle::hear(const GrantedRoad& grant) {
  if (grant.number <= newest_.number) return;

  newest_ = grant;
  obey_newest();
}

/// The newest grant counts as soon as its plan is known. One that asks back is answered by the lowest step at whose
/// end the vehicle can still stop.
void KinematicVehicle::obey_newest() {
  if (newest_.number == obeyed_) return;

  if (!way_ || newest_.plan_id != way_->plan_id) {
    const auto found = heard_ways_.find(newest_.plan_id);
    if (found == heard_ways_.end()) return;

    take(Way(found->second));
  }

  if (newest_.gives_back) {
    // At a stand it may stay where it is, within its step.
    const bool stands = speed_mps_ < 1e-3;
    const double stop_m =
        s_m_ + kinematics::stopping_distance_m(speed_mps_, kComfort * kind_.limits.max_deceleration_mps2);
    std::uint64_t lowest = std::max(newest_.limit_step, step_done_);

    while (!stands && lowest < limit_step_ && end_of_step_m(lowest) < stop_m) ++lowest;
    limit_step_ = std::min(limit_step_, lowest);
  } else {
    limit_step_ = newest_.limit_step;
  }

  obeyed_ = newest_.number;
}

/// Goes over to another way, which repeats what is granted of the old one, or begins where it stands: its place on it
/// is the nearest point of the present step.
void KinematicVehicle::take(const Way& way) {
  way_ = way;
  corners_.clear();
  along_m_.assign(1, 0.0);
  for (std::size_t i = 1; i < way.waypoints_in_map.size(); ++i)
    along_m_.push_back(along_m_.back() + geometry::distance(way.waypoints_in_map[i - 1], way.waypoints_in_map[i]));

  find_corners();
  place_on_way();
  heard_ways_.erase(heard_ways_.begin(), heard_ways_.upper_bound(way.plan_id));
}

/// Finds where it is on a new way, about the present step: on an arc that it is driving, else on the straight way.
/// Arcs that began behind it and that it does not drive are not cut any more.
void KinematicVehicle::place_on_way() {
  s_m_ = end_of_step_m(step_done_);
  if (along_m_.size() < 2) return;

  const double from_m = std::max(0.0, s_m_ - global_planner::traffic::kCornerM);
  const double to_m = std::min(along_m_.back(), end_of_step_m(step_done_ + 1) + global_planner::traffic::kCornerM);

  const auto nearest = [&] {
    std::pair<double, double> best{std::numeric_limits<double>::infinity(), s_m_};
    for (double s = from_m; s <= to_m + 1e-9; s += 2e-3) {
      const double off_m = geometry::distance(pose_at(s).position(), base_in_map_.position());
      if (off_m < best.first - 1e-6) best = {off_m, s};
    }

    return best;
  };

  const auto [off_m, straight_m] = nearest();
  s_m_ = straight_m;
  if (off_m < kAtM) {
    decide_corners_behind();
    return;
  }

  for (Corner& corner : corners_) {
    if (corner.is_cusp || corner.is_cut || std::abs(corner.at_m - straight_m) > corner.reach_m + kAtM) continue;

    corner.is_cut = true;
    const auto [off_arc_m, arc_m] = nearest();
    if (off_arc_m < off_m) {
      s_m_ = arc_m;
      break;
    }

    corner.is_cut.reset();
  }

  decide_corners_behind();
}

void KinematicVehicle::decide_corners_behind() {
  for (Corner& corner : corners_)
    if (corner.at_m - corner.reach_m < s_m_ - kAtM && !corner.is_cut) corner.is_cut = false;
}

void KinematicVehicle::find_corners() {
  corners_.clear();
  const std::vector<Point2>& points = way_->waypoints_in_map;

  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double before_m = along_m_[i] - along_m_[i - 1];
    const double after_m = along_m_[i + 1] - along_m_[i];
    if (before_m < 1e-6 || after_m < 1e-6) continue;

    Corner corner;
    corner.at_m = along_m_[i];
    corner.turn_rad =
        geometry::wrap(geometry::bearing(points[i], points[i + 1]) - geometry::bearing(points[i - 1], points[i]));

    if (!way_->headings_rad.empty()) {
      // A vehicle that does not turn on the spot drives its arcs as they are; it only stops where it changes direction.
      corner.is_cusp = std::abs(corner.turn_rad) > 2.0;
      if (corner.is_cusp) corners_.push_back(corner);
      continue;
    }

    if (std::abs(corner.turn_rad) < kStraightRad) continue;

    corner.reach_m = std::min({global_planner::traffic::kCornerM, 0.5 * before_m, 0.5 * after_m});
    if (std::abs(corner.turn_rad) > kSharpestArcRad) corner.is_cut = false;
    corners_.push_back(corner);
  }
}

double KinematicVehicle::end_of_step_m(std::uint64_t step) const {
  // Metres along the way at which the steps below `step` are behind.
  if (!way_ || step <= way_->first_step || way_->step_ends_m.empty()) return 0.0;

  const std::size_t count = static_cast<std::size_t>(step - way_->first_step);
  return way_->step_ends_m[std::min(count, way_->step_ends_m.size()) - 1];
}

double KinematicVehicle::limit_m() const { return way_ ? end_of_step_m(limit_step_) : 0.0; }

/// Metres along the way of the first point at which a thing in sight stands too near to it; infinity: none.
double KinematicVehicle::blocked_from_m(const std::vector<geometry::Body>& in_sight) {
  const double far_m = std::min(limit_m(), s_m_ + kSightM);
  std::vector<geometry::Body> near;
  for (const geometry::Body& body : in_sight)
    if (geometry::distance(body.base_in_map.position(), base_in_map_.position()) < kSightM + 2.0) near.push_back(body);

  for (double s = s_m_ + 0.1; !near.empty() && s <= far_m + 0.3; s += 0.1) {
    const geometry::Body outline = geometry::body_of(kind_.footprint, pose_at(std::min(s, far_m)));

    for (const geometry::Body& body : near) {
      if (geometry::separation_m(outline, body) >= kKeptFromThingsM) continue;

      blocker_ = body;
      return s;
    }
  }

  return std::numeric_limits<double>::infinity();
}

/// Where it has to stand still next: its limit, a corner that is not cut, or short of a thing.
double KinematicVehicle::stop_at_m(const std::vector<geometry::Body>& in_sight) {
  const double limit = limit_m();
  double stop = limit;

  for (Corner& corner : corners_) {
    if (corner.at_m <= s_m_ + kAtM || corner.at_m > limit) continue;

    const bool begins_now = s_m_ >= corner.at_m - corner.reach_m - kAtM;
    const bool may_be_cut = !corner.is_cusp && corner.at_m + corner.reach_m <= limit + 1e-6;
    if (!corner.is_cut && begins_now) corner.is_cut = may_be_cut;
    if (!corner.is_cut.value_or(may_be_cut) || corner.is_cusp) stop = std::min(stop, corner.at_m);
  }

  const double thing = blocked_from_m(in_sight);
  return std::min(stop, std::max(s_m_, thing - kStopBeforeThingsM));
}

/// The highest speed now from which it can brake to all that lies ahead.
double KinematicVehicle::allowed_mps(double stop_m, double speed_share) const {
  const double brake = kComfort * kind_.limits.max_deceleration_mps2;
  double allowed =
      std::min(speed_share * kind_.limits.max_speed_mps, std::sqrt(2.0 * brake * std::max(0.0, stop_m - s_m_)));

  if (!way_->headings_rad.empty() && !along_m_.empty()) {
    const Pose2 here = pose_at(s_m_ + 0.01);
    const Pose2 ahead = pose_at(s_m_ + 0.11);
    const bool is_back =
        std::abs(geometry::wrap(geometry::bearing(here.position(), ahead.position()) - here.yaw)) > 1.6;
    if (is_back) allowed = std::min(allowed, kind_.limits.max_reverse_mps);
  }

  for (const Corner& corner : corners_) {
    if (corner.at_m + corner.reach_m <= s_m_ || corner.is_cusp || !corner.is_cut.value_or(true)) continue;

    const double radius_m = corner.reach_m / std::max(1e-6, std::tan(0.5 * std::abs(corner.turn_rad)));
    const double in_arc = kind_.limits.max_turn_radps * radius_m;
    const double before_m = std::max(0.0, corner.at_m - corner.reach_m - s_m_);
    allowed = std::min(allowed, std::sqrt(in_arc * in_arc + 2.0 * brake * before_m));
  }

  return allowed;
}

Pose2 KinematicVehicle::pose_at(double s_m) const {
  const std::vector<Point2>& points = way_->waypoints_in_map;
  s_m = std::clamp(s_m, 0.0, along_m_.back());

  for (const Corner& corner : corners_) {
    if (!corner.is_cut.value_or(false) || corner.is_cusp) continue;
    if (s_m <= corner.at_m - corner.reach_m || s_m >= corner.at_m + corner.reach_m) continue;

    // On the arc: its part is the part of the way round the corner.
    const Pose2 begin = pose_at(corner.at_m - corner.reach_m);
    const double turned = corner.turn_rad * (s_m - corner.at_m + corner.reach_m) / (2.0 * corner.reach_m);
    const double radius = corner.reach_m / std::tan(0.5 * corner.turn_rad);  // signed: to the left
    const Point2 moved{radius * std::sin(turned), radius * (1.0 - std::cos(turned))};
    const Point2 at = geometry::to_map({begin.x, begin.y, begin.yaw}, moved);
    return {at.x, at.y, geometry::wrap(begin.yaw + turned)};
  }

  const auto after = std::upper_bound(along_m_.begin() + 1, along_m_.end() - 1, s_m - 1e-9);
  const std::size_t i = static_cast<std::size_t>(after - along_m_.begin());
  const double leg_m = along_m_[i] - along_m_[i - 1];
  const double part = leg_m > 0.0 ? (s_m - along_m_[i - 1]) / leg_m : 0.0;
  const Point2 at = points[i - 1] + part * (points[i] - points[i - 1]);

  if (way_->headings_rad.empty()) return {at.x, at.y, geometry::bearing(points[i - 1], points[i])};

  const double turn = geometry::wrap(way_->headings_rad[i] - way_->headings_rad[i - 1]);
  return {at.x, at.y, geometry::wrap(way_->headings_rad[i - 1] + part * turn)};
}

double KinematicVehicle::wanted_heading_rad() const { return pose_at(std::min(s_m_ + 2e-3, along_m_.back())).yaw; }

/// Turns towards the way while it stands. False when nothing is left to turn.
bool KinematicVehicle::turn_on_the_spot(double dt_s) {
  const double wanted = wanted_heading_rad();
  const double left = geometry::wrap(wanted - base_in_map_.yaw);
  if (std::abs(left) < kHeadingToleranceRad || !kind_.turns_on_the_spot()) return false;

  const double step = std::min(std::abs(left), kind_.limits.max_turn_radps * dt_s);
  base_in_map_.yaw = geometry::wrap(base_in_map_.yaw + std::copysign(step, left));
  return true;
}

void KinematicVehicle::advance(double metres) {
  s_m_ += metres;
  driven_m_ += metres;

  base_in_map_ = pose_at(s_m_);
  while (step_done_ < limit_step_ && end_of_step_m(step_done_ + 1) <= s_m_ + kAtM) ++step_done_;
}

void KinematicVehicle::drive(double dt_s, double speed_share, bool is_held,
                             const std::vector<geometry::Body>& in_sight) {
  is_held_ = is_held;
  is_turning_ = false;
  blocker_.reset();
  if (!way_ || along_m_.size() < 2) return;

  const double stop_m = stop_at_m(in_sight);
  const double left_m = stop_m - s_m_;

  if (speed_mps_ < 1e-3 && (is_held || left_m < 1e-3)) {
    speed_mps_ = 0.0;
    return;
  }

  if (speed_mps_ < 1e-3 && turn_on_the_spot(dt_s)) {
    is_turning_ = true;
    return;
  }

  const double wanted = is_held ? 0.0 : allowed_mps(stop_m, speed_share);
  const double up = kind_.limits.max_acceleration_mps2 * dt_s;
  const double down = kind_.limits.max_deceleration_mps2 * dt_s;
  speed_mps_ = std::clamp(wanted, speed_mps_ - down, speed_mps_ + up);

  if (left_m <= std::max(kAtM, speed_mps_ * dt_s)) {
    advance(std::max(0.0, left_m));
    speed_mps_ = 0.0;
  } else {
    advance(speed_mps_ * dt_s);
  }
}

Report KinematicVehicle::report() const {
  Report report;
  report.agv_id = agv_id_;
  report.base_in_map = base_in_map_;
  report.speed_mps = speed_mps_;
  report.plan_id = way_ ? way_->plan_id : 0;
  report.step_done = step_done_;
  report.limit_step = limit_step_;
  report.grant_number = obeyed_;
  report.is_held = is_held_;
  report.held = held();

  if (blocker_ && speed_mps_ < 0.01) {
    report.is_blocked = true;
    report.blocked_at_in_map = blocker_->base_in_map.position();
    report.blocked_radius_m = blocker_->shape == geometry::Body::Shape::kDisc
                                  ? blocker_->radius_m
                                  : 0.5 * std::hypot(blocker_->length_m, blocker_->width_m);
  }

  return report;
}

/// Where it is, and each turning point and end of a step up to its limit.
std::vector<HeldPose> KinematicVehicle::held() const {
  std::vector<HeldPose> poses{{base_in_map_, step_done_}};
  if (!way_) return poses;

  const double end_m = limit_m();
  std::uint64_t step = step_done_;
  for (std::size_t i = 0; i < along_m_.size() && along_m_[i] <= end_m + 1e-9; ++i) {
    if (along_m_[i] <= s_m_ + 1e-9) continue;
    while (step + 1 < limit_step_ && end_of_step_m(step + 1) < along_m_[i] - 1e-9) ++step;

    const Point2 at = way_->waypoints_in_map[i];
    const double yaw = way_->headings_rad.empty() ? pose_at(along_m_[i]).yaw : way_->headings_rad[i];
    poses.push_back({{at.x, at.y, yaw}, step});
  }

  return poses;
}

std::vector<Point2> KinematicVehicle::road_ahead_in_map() const {
  std::vector<Point2> road{base_in_map_.position()};
  if (!way_) return road;

  const double end_m = limit_m();
  for (std::size_t i = 0; i < along_m_.size(); ++i)
    if (along_m_[i] > s_m_ && along_m_[i] < end_m) road.push_back(way_->waypoints_in_map[i]);

  if (end_m > s_m_) road.push_back(pose_at(end_m).position());
  return road;
}

}  // namespace aisle::lab
