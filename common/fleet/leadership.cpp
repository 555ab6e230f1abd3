#include "common/fleet/leadership.hpp"

#include <algorithm>

namespace aisle::fleet {
namespace {

/// See the diagram in the header.
constexpr time::Stamp kListens = std::chrono::milliseconds(500);
constexpr time::Stamp kAlone = std::chrono::seconds(3);
constexpr time::Stamp kOutdone = std::chrono::seconds(1);  // a leader with a later epoch is heard within this

}  // namespace

/// Of two leaders with one epoch the one that started later gives way.
void Leadership::hear(std::uint32_t epoch, std::uint64_t boot_id) {
  highest_heard_ = std::max(highest_heard_, epoch);

  if (role_ == Role::kLeading) {
    must_yield_ = must_yield_ || epoch > epoch_ || (epoch == epoch_ && boot_id < boot_id_);
    return;
  }

  has_heard_ = true;
  is_leader_lost_ = false;
}

void Leadership::hear_of(std::uint32_t epoch) { highest_heard_ = std::max(highest_heard_, epoch); }

/// One transition of the diagram in the header at most.
bool Leadership::step(time::Stamp now, int others) {
  if (!is_started_) {
    is_started_ = true;
    started_ = alone_since_ = now;
  }

  if (others > 0) alone_since_ = now;

  const Role before = role_;
  switch (role_) {
    case Role::kListening:
      if (has_heard_) {
        role_ = Role::kStandby;
      } else if (now - started_ >= kListens) {
        if (starts_as_standby_) {
          role_ = Role::kStandby;
        } else {
          lead();
        }
      }

      break;

    case Role::kStandby:
      if ((has_heard_ && is_leader_lost_) || now - alone_since_ >= kAlone) lead();
      break;
    case Role::kLeading:
      if (must_yield_) {
        role_ = Role::kStandby;
        has_heard_ = true;
        is_leader_lost_ = false;
        alone_since_ = now;
      } else if (is_outdone(now, others)) {
        lead();
        return true;
      }

      break;
  }

  return role_ != before;
}

bool Leadership::is_outdone(time::Stamp now, int others) {
  if (highest_heard_ <= epoch_ || others > 0) {
    outdone_since_.reset();
    return false;
  }

  if (!outdone_since_) outdone_since_ = now;
  return now - *outdone_since_ >= kOutdone;
}

void Leadership::lead() {
  role_ = Role::kLeading;
  epoch_ = std::max(epoch_, highest_heard_) + 1;
  must_yield_ = has_heard_ = is_leader_lost_ = false;
  outdone_since_.reset();
}

}  // namespace aisle::fleet
