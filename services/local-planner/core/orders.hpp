#pragma once

#include <cstdint>
#include <optional>

#include "common/fleet/grant.hpp"
#include "common/fleet/plan.hpp"

namespace aisle::local_planner {

/// Which plan a vehicle drives, and how far it may, from the plans and grants that arrive in any order, late, doubled
/// or not at all.
///
/// A plan with steps is taken once the newest grant names it, by its id and the epoch of its planner: until then the
/// vehicle drives on with the plan and the grant that it has. Other plans are taken at once: without steps nothing is
/// granted, and one that was not found or was cancelled stops the vehicle; so is the first one after such a plan.
///
/// Of grants the one with the highest number of the newest epoch counts; an older one changes nothing. What was granted
/// before stays granted when a newer epoch is heard.
class Orders {
 public:
  /// A planner of this epoch leads, or did: grants of earlier ones are refused from now on.
  void hear(std::uint32_t epoch);

  /// The newest plan that may be followed (see fleet::PlanAuthority), of a planner of this epoch.
  void take(const fleet::Plan& plan, std::uint32_t epoch);

  /// @returns false: it is older than the newest, or of a planner that was replaced
  bool take(const fleet::Grant& grant, std::uint32_t epoch);

  /// To drive; none before the first.
  const std::optional<fleet::Plan>& plan() const { return plan_; }

  /// The newest that names `plan()`; none: nothing was granted on it yet.
  const std::optional<fleet::Grant>& grant() const { return grant_; }

  /// The newest that was heard; 0: none yet.
  std::uint32_t epoch() const { return epoch_; }

 private:
  /// Takes the plan that waits for its grant, and the grant, as far as they fit now.
  void settle();

  /// Does the newest grant name this plan?
  bool is_granted(const fleet::Plan& plan, std::uint32_t epoch) const;

  std::optional<fleet::Plan> plan_, next_;
  std::uint32_t plan_epoch_{0}, next_epoch_{0};
  std::optional<fleet::Grant> grant_, newest_;
  std::uint32_t newest_epoch_{0};  // of the newest grant
  std::uint32_t epoch_{0};
};

}  // namespace aisle::local_planner
