#pragma once
#include "common/fleet/origin.hpp"
#include "common/time/stamp.hpp"

namespace aisle::service {

/// Where a sample came from, and when. Topics without an origin (`map_tile`, `map_request`) tell only `arrived`.
struct Sender {
  fleet::Origin by;
  time::Stamp arrived{};  // our monotonic clock when the sample was taken
};

}  // namespace aisle::service
