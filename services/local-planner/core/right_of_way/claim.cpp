#include "services/local-planner/core/right_of_way/claim.hpp"

#include <algorithm>
#include <cstddef>

namespace aisle::local_planner {
namespace {

constexpr double kIntentM = 24.0;          // of the way are claimed, at most,
constexpr std::size_t kIntentPoints = 60;  // in about so many points,
constexpr double kLeastStepM = 0.35;       // none nearer to the one before
constexpr double kBeyondStepM = 0.5;       // for the time from the claim's end to the way's
constexpr double kSlowestMps = 0.25;       // for times: it will not stand there for long
constexpr double kRoundingM = 1e-9;

}  // namespace

Claim claim_of(const Way& way, double end_m) {
  const Route& route = way.current();
  const double end = std::min({route.length_m(), way.s_m() + kIntentM, end_m});
  const double step = std::max(kLeastStepM, (end - way.s_m()) / static_cast<double>(kIntentPoints));
  Claim claim;
  double& t = claim.time_left_s;

  for (double s = way.s_m() + step; s < end + step - kRoundingM; s += step) {
    const double at = std::min(s, end);
    t += step / std::max(kSlowestMps, way.speed_at(at));
    const geometry::Point2 p = route.at(at);
    claim.points.push_back({t, {p.x, p.y, route.heading_at(at)}});
  }

  for (double s = end; s < route.length_m(); s += kBeyondStepM)
    t += kBeyondStepM / std::max(kSlowestMps, way.speed_at(s));
  return claim;
}

}  // namespace aisle::local_planner
