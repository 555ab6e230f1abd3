#pragma once
#include <cstdint>
#include <string>

#include "common/time/stamp.hpp"

namespace aisle::service {

/// Where a sample came from, and when. Topics without an origin (`map_tile`, `map_request`) tell only `arrived`.
struct Sender {
  std::string source_id;             // instance id of the service that wrote it
  std::uint64_t boot_id{0};          // of its process; a later start has a higher one
  std::uint32_t epoch{0};            // of its authority, where there is one
  std::uint64_t sequence_number{0};  // of its writer, from 1
  std::int64_t stamp_ns{0};          // its wall clock when it wrote, nanoseconds since the Unix epoch
  time::Stamp arrived{};             // our monotonic clock when the sample was taken
};

}  // namespace aisle::service
