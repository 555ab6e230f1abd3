#pragma once

#include <cstdint>
#include <optional>

#include "common/time/stamp.hpp"

namespace aisle::fake_vehicle {

/// Finds another live process that says it is this vehicle. The process that started first (the smaller boot id) keeps
/// the name; the newcomer must stay silent and stand for as long as the other is heard. What a killed predecessor left
/// on its way through the network does not count: the other must be heard over a span of kSpan.
class DuplicateWatch {
 public:
  explicit DuplicateWatch(std::uint64_t own_boot_id) : own_boot_id_(own_boot_id) {}

  /// A process said that it is alive and is this vehicle; it does so once a second.
  void heard(std::uint64_t boot_id, time::Stamp now);

  /// Another process is this vehicle as well: heard over kSpan, and within the last kSilence.
  bool is_duplicate(time::Stamp now) const;

  /// There is a duplicate, and it was first.
  bool must_yield(time::Stamp now) const { return is_duplicate(now) && other_boot_id_ < own_boot_id_; }

  /// An earlier process has said within kSilence that it is this vehicle. Once is enough to keep a newcomer that has
  /// said nothing yet from introducing itself.
  bool is_taken(time::Stamp now) const;

  /// The process heard last; 0: none.
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
