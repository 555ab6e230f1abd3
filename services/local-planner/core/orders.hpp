#pragma once

#include <optional>

#include "common/fleet/claim.hpp"
#include "common/fleet/grant.hpp"
#include "common/fleet/plan.hpp"

namespace aisle::local_planner {

/// Which plan a vehicle drives, and how far it may, from the plans and grants that arrive in any order, late, doubled
/// or not at all.
///
/// A plan with steps is taken once the newest grant of the same planner names it by its id: until then the
/// vehicle drives on with the plan and the grant that it has. Other plans are taken at once: without steps nothing is
/// granted, and one that was not found or was cancelled stops the vehicle; so is the first one after such a plan.
///
/// Of planners the one that outranks all others heard is obeyed, and of its grants the one with the highest number; an
/// older one changes nothing. What was granted before stays granted when another planner is heard.
class Orders {
 public:
  /// A planner leads, or did: plans and grants of those that it outranks are refused from now on.
  void hear(const fleet::Claim& by);

  /// The newest plan that may be followed (see fleet::PlanAuthority).
  /// @returns false: of a planner that was replaced
  bool take(const fleet::Plan& plan, const fleet::Claim& by);

  /// @returns false: it is older than the newest, or of a planner that was replaced
  bool take(const fleet::Grant& grant, const fleet::Claim& by);

  /// To drive; none before the first.
  const std::optional<fleet::Plan>& plan() const { return plan_; }

  /// The newest that names `plan()`; none: nothing was granted on it yet.
  const std::optional<fleet::Grant>& grant() const { return grant_; }

  /// The planner that is obeyed; epoch 0: none yet.
  const fleet::Claim& obeyed() const { return obeyed_; }

  /// The planner that gave the newest grant() there was; epoch 0: there was none.
  const fleet::Claim& granted_by() const { return granted_by_; }

 private:
  /// Takes the plan that waits for its grant, and the grant, as far as they fit now.
  void settle();

  /// Does the newest grant name this plan?
  bool is_granted(const fleet::Plan& plan, const fleet::Claim& by) const;

  std::optional<fleet::Plan> plan_, next_;
  fleet::Claim plan_by_, next_by_;
  std::optional<fleet::Grant> grant_, newest_;
  fleet::Claim newest_by_;  // of the newest grant
  fleet::Claim granted_by_;
  fleet::Claim obeyed_;
};

}  // namespace aisle::local_planner
