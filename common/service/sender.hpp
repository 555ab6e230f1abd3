#pragma once

#include "common/fleet/origin.hpp"
#include "common/time/stamp.hpp"

namespace aisle::service {

/// The source of a sample and its time of arrival. Topics without an origin (`map_tile`, `map_request`)
/// give only `arrived`.
struct Sender {
  fleet::Origin by;
  time::Stamp arrived{};  // our monotonic clock when the sample was taken
};

}  // namespace aisle::service
