#pragma once

#include <cstddef>

namespace aisle::draw {

/// Colours for things of one kind, in turn and then repeated: the first six can be told apart with any
/// colour vision (Okabe, Ito 2008), four darker ones follow. `of_first`: only so many of them are used,
/// 1 to 10.
const char* colour(std::size_t index, std::size_t of_first = 10);

inline constexpr const char* kInk = "#1f2933";      // headings, values
inline constexpr const char* kSoftInk = "#323f4b";  // names in a drawing
inline constexpr const char* kFaint = "#7b8794";    // axes, remarks
inline constexpr const char* kGridLine = "#e4e7eb";
inline constexpr const char* kBorder = "#cbd2d9";
inline constexpr const char* kAlarm = "#d11149";
inline constexpr const char* kWall = "#4a5462";
inline constexpr const char* kUnknown = "#d5dae1";  // of a map: neither free nor occupied
inline constexpr const char* kSansSerif = "font-family=\"sans-serif\"";

}  // namespace aisle::draw
