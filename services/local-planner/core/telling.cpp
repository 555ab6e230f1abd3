#include "services/local-planner/core/telling.hpp"

#include <algorithm>
#include <cstddef>

#include "services/local-planner/core/rolling_window.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kIntentM = 24.0;
constexpr std::size_t kIntentPoints = 60;
constexpr double kSlowestMps = 0.25;  // for times: it will not stand there for long

}  // namespace

void tell_why_it_stands(const Stop& stop, Output& out) {
  if (!stop.advice.yields_to.empty() && !stop.blocked) {
    out.phase = Phase::kWaiting;
    out.reason = stop.advice.follows ? Reason::kVehicle : Reason::kYielding;
    out.detail = (stop.advice.follows ? "behind " : "yields to ") + stop.advice.yields_to;
  } else if (stop.stuck_s > stop.blocked_after_s && stop.blocked) {
    const std::string& by = stop.blocked->vehicle_id;
    out.phase = Phase::kBlocked;
    out.reason = by.empty() ? Reason::kObstacle : Reason::kVehicle;
    out.detail = by.empty() ? "no way around" : "no way around " + by;
    out.blocked_at_in_map = stop.blocked->where.at_in_map;
    out.blocked_radius_m = stop.radius_m;
  } else if (stop.stuck_s > 0.5) {
    const bool mover = stop.choice.rejected[static_cast<int>(Obstruction::kMover)] > 0;
    const bool peer = stop.choice.rejected[static_cast<int>(Obstruction::kPeer)] > 0;
    out.reason = peer ? Reason::kVehicle : mover ? Reason::kObstacle : Reason::kNone;
  }
}

std::string told_avoidance(const Scene& scene) {
  const Meeting meeting = predict_meeting(scene, kWindowM, kMeetingS);
  return meeting.encounter == Encounter::kNone ? "" : std::string("avoids what is ") + name(meeting.encounter);
}

Claim claim_of(const Way& way, double end_m) {
  const Route& route = way.current();
  const double end = std::min({route.length_m(), way.s_m() + kIntentM, end_m});
  const double step = std::max(0.35, (end - way.s_m()) / static_cast<double>(kIntentPoints));
  Claim claim;
  double& t = claim.time_left_s;
  for (double s = way.s_m() + step; s < end + step - 1e-9; s += step) {
    const double at = std::min(s, end);
    t += step / std::max(kSlowestMps, way.speed_at(at));
    const geometry::Point2 p = route.at(at);
    claim.points.push_back({t, {p.x, p.y, route.heading_at(at)}});
  }
  for (double s = end; s < route.length_m(); s += 0.5) t += 0.5 / std::max(kSlowestMps, way.speed_at(s));
  return claim;
}

}  // namespace aisle::local_planner
