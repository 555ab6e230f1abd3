#include "services/local-planner/core/recovery.hpp"

#include <algorithm>

#include "services/local-planner/core/tube.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kLookAroundRad = 0.1;  // apart are the headings that are tried where walls refuse all that moves
constexpr double kTryS = 3.0;           // of trying without getting on, besides a turn about on the spot
constexpr double kLongerS = 4.0;        // after each time that did not help,
constexpr int kMostLonger = 5;          // so often
constexpr double kGoodPieceM = 0.5;     // nearer to the goal: it gets on

/// Only walls, or the tube's borders, refused something.
bool is_walled(const Choice& choice) {
  return choice.rejected_by(Obstruction::kWall) + choice.rejected_by(Obstruction::kTube) == choice.rejected_in_all();
}

/// The same window with twice as many speeds and turn rates.
Choice look_finer(const Refusal& refusal, const Variant& variant, DwaSettings settings) {
  settings.linear_samples = 2 * settings.linear_samples - 1;
  settings.angular_samples = 2 * settings.angular_samples - 1;

  return choose(refusal.scene, refusal.aim, variant, settings);
}

/// The smallest turn, from the target's heading to both sides, after which it may set off straight ahead; none: there
/// is no such heading.
std::optional<double> nearest_open_turn_rad(const Refusal& refusal, const DwaSettings& settings) {
  for (double off = 0.0; off < geometry::kPi; off += kLookAroundRad)
    for (const double turn : {refusal.to_target_rad + off, refusal.to_target_rad - off}) {
      Scene turned = refusal.scene;
      turned.base_in_map.yaw = geometry::wrap(refusal.scene.base_in_map.yaw + turn);

      turned.twist = {};
      const geometry::Twist2 sets_off{turned.limits.max_speed_mps, 0.0, 0.0};
      const bool keeps_to_tube = turned.tube == nullptr || TubeKeeping(turned, *turned.tube, settings).to(sets_off);
      if (keeps_to_tube && obstruction(turned, sets_off, settings) == Obstruction::kNone) return geometry::wrap(turn);
    }

  return std::nullopt;
}

}  // namespace

const char* told(Grade grade) {
  switch (grade) {
    case Grade::kSlower:
      return "recovers: slower";
    case Grade::kFiner:
      return "recovers: looks finer";
    case Grade::kTurn:
      return "recovers: turns to where there is room";
    case Grade::kBackOff:
      return "recovers: backs off";
    case Grade::kNone:
    case Grade::kAsk:
      break;
  }

  return "";
}

bool is_refused(const Choice& choice) { return choice.rejected_in_all() > 0 && choice.moving == 0; }

WayOut way_out(const Refusal& refusal, const Variant& variant, const DwaSettings& settings) {
  if (!refusal.stands) return {Grade::kSlower, refusal.choice};
  if (!is_walled(refusal.choice)) return {Grade::kTurn, refusal.choice};
  if (const Choice finer = look_finer(refusal, variant, settings); finer.moving > 0) return {Grade::kFiner, finer};

  return {Grade::kTurn, refusal.choice, refusal.may_turn ? nearest_open_turn_rad(refusal, settings) : std::nullopt};
}

void Patience::begin(time::Stamp now) { *this = {}, progressed_ = now; }

void Patience::lengthen(double longer_m) {
  least_left_m_ += longer_m;
  best_left_m_ += longer_m;
}

Grade Patience::look(const Attempt& attempt, time::Stamp now) {
  if (attempt.left_m < least_left_m_ - kGoodPieceM) {
    least_left_m_ = attempt.left_m;
    progressed_ = now;
  }

  if (attempt.left_m < best_left_m_ - kGoodPieceM) {
    best_left_m_ = attempt.left_m;
    recoveries_ = 0;
  }

  if (attempt.backs_off) least_left_m_ = attempt.left_m;

  if (attempt.waits || attempt.backs_off || attempt.is_closed) {
    progressed_ = now;
    return attempt.is_closed ? Grade::kAsk : Grade::kNone;
  }

  // A turn about on the spot takes pi / rate at full rate, and rate / acceleration to get there and back.
  const kinematics::Limits& limits = attempt.limits;
  const double half_turn_s =
      geometry::kPi / limits.max_turn_radps + limits.max_turn_radps / limits.max_turn_acceleration_radps2;
  if (time::seconds(now - progressed_) < kTryS + half_turn_s + kLongerS * std::min(recoveries_, kMostLonger))
    return Grade::kNone;
  progressed_ = now;
  ++recoveries_;

  return Grade::kBackOff;
}

}  // namespace aisle::local_planner
