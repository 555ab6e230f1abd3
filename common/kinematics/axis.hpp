#pragma once

namespace aisle::kinematics {

/// One axis of a motion (speed or turn rate): from `current` towards `wanted`, by at most its limits
/// times `dt_s` seconds, and never beyond `wanted`.
///
/// Away from zero it changes by `speed_up`, towards zero by `slow_down` (both > 0, units of the axis a
/// second). Through zero, the time that is left after the stand is spent at `speed_up`.
double approach(double current, double wanted, double speed_up, double slow_down, double dt_s);

}  // namespace aisle::kinematics
