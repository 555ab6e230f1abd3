#include "services/local-planner/core/orders.hpp"

#include <algorithm>
#include <tuple>

namespace aisle::local_planner {
namespace {

/// Is it driven by steps, each of which must be granted?
bool has_road(const fleet::Plan& plan) { return plan.is_found() && !plan.step_ends_m.empty(); }

}  // namespace

void Orders::hear(std::uint32_t epoch) { epoch_ = std::max(epoch_, epoch); }

void Orders::take(const fleet::Plan& plan, std::uint32_t epoch) {
  hear(epoch);
  const bool is_repeated = plan_ && plan.id == plan_->id && epoch == plan_epoch_;
  const bool stands_anyway = !plan_ || !has_road(*plan_);
  next_ = plan;
  next_epoch_ = epoch;

  if (is_repeated || stands_anyway || !has_road(plan)) {
    plan_ = next_;
    plan_epoch_ = next_epoch_;
    next_.reset();
    if (!is_repeated) grant_.reset();
  }

  settle();
}

bool Orders::take(const fleet::Grant& grant, std::uint32_t epoch) {
  hear(epoch);
  if (epoch < epoch_) return false;
  if (newest_ && std::tie(epoch, grant.number) <= std::tie(newest_epoch_, newest_->number)) return false;

  newest_ = grant;
  newest_epoch_ = epoch;
  settle();
  return true;
}

bool Orders::is_granted(const fleet::Plan& plan, std::uint32_t epoch) const {
  return newest_ && newest_->plan_id == plan.id && newest_epoch_ == epoch;
}

void Orders::settle() {
  if (next_ && is_granted(*next_, next_epoch_)) {
    plan_ = next_;
    plan_epoch_ = next_epoch_;
    next_.reset();
  }

  if (plan_ && is_granted(*plan_, plan_epoch_)) grant_ = newest_;
}

}  // namespace aisle::local_planner
