#include "services/local-planner/core/intent.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::local_planner {
namespace {

constexpr double kIntentM = 24.0;     // of the way are told, at most,
constexpr int kIntentPoints = 7;      // in so many points at most,
constexpr double kLeastStepM = 0.35;  // none nearer to the one before
constexpr double kStepM = 0.5;        // along which a speed is taken to be the same
constexpr double kSlowestMps = 0.25;  // for times: it will not stand there for long

/// How long the way from one s to another takes.
double time_between_s(const Way& way, double from_m, double to_m) {
  double t = 0.0;
  for (double s = from_m; s < to_m; s += kStepM) {
    const double step = std::min(kStepM, to_m - s);
    t += step / std::max(kSlowestMps, way.speed_at(s + step));
  }

  return t;
}

}  // namespace

Intent intent_of(const Way& way, double end_m) {
  const Route& route = way.current();
  const double end = std::min({route.length_m(), way.s_m() + kIntentM, end_m});
  const double ahead = end - way.s_m();
  const int points = std::clamp(static_cast<int>(ahead / kLeastStepM), ahead > 0.0 ? 1 : 0, kIntentPoints);

  Intent intent;
  double from = way.s_m();
  for (int i = 1; i <= points; ++i) {
    const double s = way.s_m() + ahead * i / points;
    intent.time_left_s += time_between_s(way, from, s);
    const geometry::Point2 p = route.at(s);
    intent.points.push_back({intent.time_left_s, {p.x, p.y, route.heading_at(s)}});
    from = s;
  }

  intent.time_left_s += time_between_s(way, from, route.length_m());
  return intent;
}

}  // namespace aisle::local_planner
