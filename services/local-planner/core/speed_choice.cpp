#include "services/local-planner/core/speed_choice.hpp"

#include <algorithm>

#include "services/local-planner/core/turning.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Twist2;

constexpr double kWalksByM = 1.0;                   // between the outlines: a person so near may refuse what moves
constexpr double kMayMoveMps = 2.0 * kStandingMps;  // a lower speed cap asks for no recovery

/// Does a person walk by, near enough to refuse what moves?
bool is_passed_by(const SpeedSearch& search) {
  const auto& movers = search.scene.movers;

  return std::any_of(movers.begin(), movers.end(), [&](const Mover& mover) {
    return mover.velocity_in_map != geometry::Point2{} && search.moment.gap_then_m(mover) < kWalksByM;
  });
}

/// Nothing where it stays, the recovery's turn, the best sample, or braking.
Twist2 wanted_twist(const SpeedSearch& search, const WayOut& way_out) {
  if (search.stays_here) return {};
  if (way_out.turn_rad) return turn_by(*way_out.turn_rad, search.moment.vehicle.limits);

  return way_out.choice.found ? way_out.choice.twist : search.braking;
}

}  // namespace

SpeedChoice choose_speed(const SpeedSearch& search, const Variant& variant, const DwaSettings& settings) {
  const Vehicle& vehicle = search.moment.vehicle;
  WayOut found{Grade::kNone, choose(search.scene, search.aim, variant, settings)};

  // Refused, though it might move: recover.
  const bool may_move = search.scene.speed_cap_mps > kMayMoveMps && !search.stays_here;
  if (may_move && is_refused(found.choice)) {
    const bool may_turn = vehicle.turns_on_the_spot() && vehicle.footprint.is_disc();
    found = way_out({search.scene, search.aim, found.choice, search.moment.motion.stands(), may_turn, search.error_rad},
                    variant, settings);
  }

  const bool is_refused_by_people =
      found.grade != Grade::kNone && found.choice.rejected_by(Obstruction::kMover) > 0 && is_passed_by(search);

  return {wanted_twist(search, found), found.grade, found.choice, is_refused_by_people};
}

}  // namespace aisle::local_planner
