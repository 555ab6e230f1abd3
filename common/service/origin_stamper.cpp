#include "common/service/origin_stamper.hpp"

#include <utility>

namespace aisle::service {

OriginStamper::OriginStamper(const bus::Bus& bus, std::string source_id, std::uint64_t boot_id, std::uint32_t epoch)
    : bus_(&bus), source_id_(std::move(source_id)), boot_id_(boot_id), epoch_(epoch) {}

aisle::Origin OriginStamper::next() {
  aisle::Origin origin;
  origin.source_id(source_id_);
  origin.boot_id(boot_id_);
  origin.epoch(epoch_);
  origin.sequence_number(++sequence_number_);
  origin.stamp_ns(bus_->wall_clock_ns());

  return origin;
}

}  // namespace aisle::service
