#include "common/kinematics/axis.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::kinematics {

/// |v| falls at most by slow_down dt, and rises at most by speed_up dt; through zero in two parts.
double approach(double current, double wanted, double speed_up, double slow_down, double dt_s) {
  const bool through_zero = current * wanted < 0.0;
  if (through_zero) {
    const double stop_s = std::abs(current) / slow_down;
    if (stop_s >= dt_s) return current - std::copysign(slow_down * dt_s, current);
    return std::copysign(std::min(std::abs(wanted), speed_up * (dt_s - stop_s)), wanted);
  }

  const double rate = std::abs(wanted) < std::abs(current) ? slow_down : speed_up;
  return current + std::clamp(wanted - current, -rate * dt_s, rate * dt_s);
}

}  // namespace aisle::kinematics
