#pragma once
#include <array>
#include <cstddef>

namespace aisle::local_planner {

/// So many samples are rolled out and scored side by side, in arrays that compilers make vectors of.
inline constexpr std::size_t kLanes = 32;
using Lane = std::array<double, kLanes>;

/// By value, which loops over lanes need to become vectors; std::min takes references.
inline double least(double a, double b) { return b < a ? b : a; }
inline double most(double a, double b) { return a < b ? b : a; }
inline double within(double value, double low, double high) { return least(most(value, low), high); }

}  // namespace aisle::local_planner
