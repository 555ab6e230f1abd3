#pragma once

#include <cstdint>

namespace aisle::service {

/// Raised with every change of idl/ that older programs cannot read. Programs of different versions name each other.
inline constexpr std::uint32_t kIdlVersion = 3;

}  // namespace aisle::service
