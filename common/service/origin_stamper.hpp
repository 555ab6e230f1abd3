#pragma once
#include <cstdint>
#include <string>

#include "idl/geometry.hpp"

namespace aisle::service {

/// Stamps the samples of one writer: source, boot, epoch, sequence number from 1, wall clock.
class OriginStamper {
 public:
  OriginStamper(std::string source_id, std::uint64_t boot_id, std::uint32_t epoch = 1);
  aisle::Origin next();
  void set_epoch(std::uint32_t epoch) { epoch_ = epoch; }
  std::uint32_t epoch() const { return epoch_; }

 private:
  std::string source_id_;
  std::uint64_t boot_id_;
  std::uint32_t epoch_;
  std::uint64_t sequence_number_{0};
};

}  // namespace aisle::service
