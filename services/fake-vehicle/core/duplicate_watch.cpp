#include "services/fake-vehicle/core/duplicate_watch.hpp"

namespace aisle::fake_vehicle {

void DuplicateWatch::heard(std::uint64_t boot_id, time::Stamp now) {
  if (boot_id == own_boot_id_) return;

  // A span of being heard begins with a new process, and after a silence.
  const bool is_new = !first_heard_ || boot_id != other_boot_id_ || now - last_heard_ > kSilence;
  if (is_new) first_heard_ = now;

  other_boot_id_ = boot_id;
  last_heard_ = now;
}

bool DuplicateWatch::is_duplicate(time::Stamp now) const {
  return first_heard_ && last_heard_ - *first_heard_ >= kSpan && now - last_heard_ <= kSilence;
}

bool DuplicateWatch::is_taken(time::Stamp now) const {
  return first_heard_ && other_boot_id_ < own_boot_id_ && now - last_heard_ <= kSilence;
}

}  // namespace aisle::fake_vehicle
