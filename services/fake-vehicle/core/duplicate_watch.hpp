#pragma once
#include <cstdint>
#include <optional>

#include "common/time/stamp.hpp"

namespace aisle::fake_vehicle {

/// Finds another live process that says it is this vehicle. The one that started first (the smaller boot id) keeps the
/// name; the newcomer must stay silent and stand for as long as the other is heard. What a killed predecessor left on
/// the way does not count: the other must be heard over a span of kSpan.
class DuplicateWatch {
 public:
  explicit DuplicateWatch(std::uint64_t own_boot_id) : own_boot_id_(own_boot_id) {}

  /// A process said that it is alive and is this vehicle; it does so once a second.
  void heard(std::uint64_t boot_id, time::Stamp now);

  /// Somebody else is this vehicle as well.
  bool is_duplicate(time::Stamp now) const;
  /// ... and was first.
  bool must_yield(time::Stamp now) const { return is_duplicate(now) && other_boot_id_ < own_boot_id_; }
  /// An earlier process has said within kSilence that it is this vehicle. Once is enough to keep a newcomer that has
  /// said nothing yet from introducing itself.
  bool is_taken(time::Stamp now) const;
  std::uint64_t other_boot_id() const { return other_boot_id_; }

  static constexpr std::chrono::milliseconds kSpan{200};
  static constexpr std::chrono::milliseconds kSilence{2500};

 private:
  std::uint64_t own_boot_id_;
  std::uint64_t other_boot_id_{0};
  std::optional<time::Stamp> first_heard_;
  time::Stamp last_heard_{};
};

}  // namespace aisle::fake_vehicle
