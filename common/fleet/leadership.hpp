#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "common/time/stamp.hpp"

namespace aisle::fleet {

/// Which planner plans when several run: one leads, the others stand by and know its plans. A planner
/// that takes over raises the epoch, so that receivers can refuse one that was thought dead and comes
/// back. Giving the lead back is a person's decision.
///
///     listening ──0.5 s without a plan of another──► leading ──hears a higher epoch──► standby
///         └──── hears a plan, or was told to ────► standby ──leader lost, or nobody for 3 s──► leading, epoch + 1
///
/// Followers of plans publish the epoch that they follow. So a planner that finds no other one still
/// begins above the epoch of those that died. One that learns of a later epoch, while no planner with
/// it is there, raises its own above it after a second.
class Leadership {
 public:
  /// Only a leading planner writes plans.
  enum class Role { kListening, kStandby, kLeading };

  /// `boot_id`: of this process; of two leaders with one epoch the one that started later gives way.
  Leadership(bool starts_as_standby, std::uint64_t boot_id)
      : starts_as_standby_(starts_as_standby), boot_id_(boot_id) {}

  /// A plan of another planner came.
  void hear(std::uint32_t epoch, std::uint64_t boot_id);

  /// Somebody follows plans of this epoch, or did.
  void hear_of(std::uint32_t epoch);

  /// A plan of another planner has no live writer any more.
  void lose_leader() { is_leader_lost_ = true; }

  /// Looks at the time; `others` is the number of other planners' writers. True when the role or the epoch of this
  /// leader changed.
  bool step(time::Stamp now, int others);

  Role role() const { return role_; }

  /// In force while leading; at least 1.
  std::uint32_t epoch() const { return epoch_; }

  /// The highest of ours and of those heard of.
  std::uint32_t highest_epoch() const { return std::max(epoch_, highest_heard_); }

 private:
  /// Takes the lead with an epoch above all heard of.
  void lead();

  /// Has a later epoch been followed for a second without a planner that leads with it?
  bool is_outdone(time::Stamp now, int others);

  bool starts_as_standby_;
  std::uint64_t boot_id_;
  Role role_{Role::kListening};
  std::uint32_t epoch_{0};
  std::uint32_t highest_heard_{0};
  bool has_heard_{false};  // of another planner, since the role changed
  bool must_yield_{false};
  bool is_leader_lost_{false};
  std::optional<time::Stamp> outdone_since_;  // a later epoch than ours is followed, and nobody leads with it
  bool is_started_{false};
  time::Stamp started_{};
  time::Stamp alone_since_{};
};

}  // namespace aisle::fleet
