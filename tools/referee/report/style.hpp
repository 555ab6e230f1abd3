#pragma once

#include <cstddef>

namespace aisle::referee {

/// Of both pictures.
inline constexpr const char* kFont = "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\"";
inline constexpr const char* kGood = "#2f855a";     // passed; freed in the map
inline constexpr const char* kBlocked = "#b7791f";  // in the map
inline constexpr std::size_t kVehicleColours = 8;

}  // namespace aisle::referee
