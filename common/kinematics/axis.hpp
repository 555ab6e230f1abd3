#pragma once

namespace aisle::kinematics {

/// One axis: from `current` towards `wanted`, within `dt_s`. Away from zero at `speed_up`, towards zero at `slow_down`
/// (both > 0, units of the axis a second); through zero, the time that is left after the stand is spent at `speed_up`.
double approach(double current, double wanted, double speed_up, double slow_down, double dt_s);

}  // namespace aisle::kinematics
