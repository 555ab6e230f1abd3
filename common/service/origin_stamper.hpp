#pragma once

#include <cstdint>
#include <string>

#include "common/bus/bus.hpp"
#include "common/wire/origin.hpp"

namespace aisle::service {

/// Stamps the samples of one writer: source, boot, epoch, sequence number from 1, wall clock.
class OriginStamper {
 public:
  /// `bus`: its wall clock; it must live as long.
  OriginStamper(const bus::Bus& bus, std::string source_id, std::uint64_t boot_id, std::uint32_t epoch = 1);

  /// For the next sample: the sequence number rises by one.
  aisle::Origin next();
  void set_epoch(std::uint32_t epoch) { epoch_ = epoch; }
  std::uint32_t epoch() const { return epoch_; }

 private:
  const bus::Bus* bus_;
  std::string source_id_;
  std::uint64_t boot_id_;
  std::uint32_t epoch_;
  std::uint64_t sequence_number_{0};
};

}  // namespace aisle::service
