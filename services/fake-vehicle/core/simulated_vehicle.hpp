#pragma once
#include <cstdint>
#include <deque>
#include <random>

#include "common/fleet/vehicle_state.hpp"
#include "common/kinematics/vehicle_model.hpp"
#include "common/time/stamp.hpp"
#include "services/fake-vehicle/core/parameters.hpp"
#include "services/fake-vehicle/core/surroundings.hpp"

namespace aisle::fake_vehicle {

using fleet::Hold;

/// A vehicle of any model: follows commands after a dead time and with a first-order lag, within its limits, and brakes
/// by itself, with its full deceleration and without lag, when no command came for command_timeout_s. It cannot pass
/// through things: where a motion would press it deeper into a wall or a body, it stands (a disc may turn on the spot
/// all the same).
///
///   no command ──command──► driving ──silence──► late ──command──► driving
///                              └─would overlap─► contact ──a motion that does not──┘
///
/// Time is what the caller says; commands and steps come in order of time.
class SimulatedVehicle {
 public:
  SimulatedVehicle(const Parameters& parameters, const geometry::Pose2& start_in_map);

  /// An accepted command.
  void command(const geometry::Twist2& twist, time::Stamp arrived);

  /// Moves on to `now` in steps of at most 5 ms. Time beyond kLongestGap since the last call is time in which the
  /// simulation did not run, and the vehicle did not move.
  void advance_to(time::Stamp now, const Surroundings& around);

  const geometry::Pose2& base_in_map() const { return base_in_map_; }
  const geometry::Twist2& twist() const { return drive_.twist; }
  double steering_rad() const { return drive_.steering_rad; }
  Hold hold() const { return hold_; }
  /// How often it was stopped by a wall or a body.
  std::uint64_t contacts() const { return contacts_; }

  static constexpr std::chrono::milliseconds kLongestGap{100};

 private:
  struct Queued {
    geometry::Twist2 twist;
    time::Stamp effective;
  };
  void step(time::Stamp now, double dt_s, const Surroundings& around);
  kinematics::DriveState follow(double dt_s) const;
  kinematics::DriveState brake(double dt_s) const;
  void move(double dt_s, const Surroundings& around);

  Parameters parameters_;
  geometry::Pose2 base_in_map_;
  kinematics::DriveState drive_;
  geometry::Twist2 wanted_;
  std::deque<Queued> queued_;
  bool commanded_{false};
  time::Stamp last_command_{};
  bool started_{false};
  time::Stamp time_{};
  Hold hold_{Hold::kNoCommand};
  std::uint64_t contacts_{0};
};

/// What the vehicle believes of its pose.
geometry::Pose2 with_noise(const geometry::Pose2& base_in_map, const Parameters& parameters, std::mt19937_64& random);

}  // namespace aisle::fake_vehicle
