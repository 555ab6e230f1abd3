#include "services/local-planner/core/orders.hpp"

namespace aisle::local_planner {
namespace {

/// Is it driven by steps, each of which must be granted?
bool has_road(const fleet::Plan& plan) { return plan.is_found() && !plan.step_ends_m.empty(); }

}  // namespace

void Orders::hear(const fleet::Claim& by) {
  if (obeyed_.epoch == 0 || outranks(by, obeyed_)) obeyed_ = by;
}

bool Orders::take(const fleet::Plan& plan, const fleet::Claim& by) {
  hear(by);
  if (by != obeyed_) return false;

  const bool is_repeated = plan_ && plan.id == plan_->id && by == plan_by_;
  const bool stands_anyway = !plan_ || !has_road(*plan_);
  next_ = plan;
  next_by_ = by;

  if (is_repeated || stands_anyway || !has_road(plan)) {
    plan_ = next_;
    plan_by_ = next_by_;
    next_.reset();
    if (!is_repeated) grant_.reset();
  }

  settle();
  return true;
}

bool Orders::take(const fleet::Grant& grant, const fleet::Claim& by) {
  hear(by);
  if (by != obeyed_) return false;
  if (newest_ && newest_by_ == by && grant.number <= newest_->number) return false;

  newest_ = grant;
  newest_by_ = by;
  settle();
  return true;
}

bool Orders::is_granted(const fleet::Plan& plan, const fleet::Claim& by) const {
  return newest_ && newest_->plan_id == plan.id && newest_by_ == by;
}

void Orders::settle() {
  if (next_ && is_granted(*next_, next_by_)) {
    plan_ = next_;
    plan_by_ = next_by_;
    next_.reset();
  }

  if (plan_ && is_granted(*plan_, plan_by_)) {
    grant_ = newest_;
    granted_by_ = newest_by_;
  }
}

}  // namespace aisle::local_planner
