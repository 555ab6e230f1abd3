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

/// What keeps a vehicle from doing what it is told, beside its own limits.
struct Hindrance {
  bool is_held{false};      // by a person: it brakes and stands
  double speed_share{1.0};  // of its top speed that it reaches, above 0, to 1
};

/// A vehicle of any model: follows commands after a dead time and with a first-order lag, within its limits, and brakes
/// by itself, with its full deceleration and without lag, when no command came for command_timeout_s. It cannot pass
/// through things: where a motion would press it deeper into a wall or a body, it stands (a disc may turn on the spot
/// all the same).
///
///   no command ──command──► driving ──silence──► late ──command──► driving
///                              └─would overlap─► contact ──a motion that does not──┘
/// A person may hold it in any of these: it brakes, and goes on as it is told when the person lets go.
///
/// Reads no clock: each call says what time it is, and the times of calls never go back.
class SimulatedVehicle {
 public:
  /// Stands at `start_in_map` and waits for its first command.
  SimulatedVehicle(const Parameters& parameters, const geometry::Pose2& start_in_map);

  /// Takes a command whose source may give it; in force after the dead time. `arrived`: also begins the time-out anew.
  void command(const geometry::Twist2& twist, time::Stamp arrived);

  /// In force until the next call.
  void hinder(const Hindrance& hindrance) { hindrance_ = hindrance; }

  /// Moves on to `now` in steps of at most 5 ms. A gap of more than kLongestGap since the last call means that the
  /// simulation did not run: the vehicle moves for one step only.
  void advance_to(time::Stamp now, const Surroundings& around);

  const geometry::Pose2& base_in_map() const { return base_in_map_; }

  /// In its own frame, m/s and rad/s.
  const geometry::Twist2& twist() const { return drive_.twist; }

  /// Angle of a tricycle's steered wheel, counter-clockwise; 0 for other models.
  double steering_rad() const { return drive_.steering_rad; }

  /// Why it does not do what it was told, if so.
  Hold hold() const { return hold_; }

  /// How often it was stopped by a wall or a body.
  std::uint64_t contacts() const { return contacts_; }

  static constexpr std::chrono::milliseconds kLongestGap{100};

 private:
  /// A command on its way through the dead time.
  struct Queued {
    geometry::Twist2 twist;
    time::Stamp effective;
  };

  /// One step of the drives, and of the body.
  void step(time::Stamp now, double dt_s, const Surroundings& around);

  /// The drives after dt_s towards `wanted_`: first-order lag, then limits.
  kinematics::DriveState follow(double dt_s) const;

  /// The drives after dt_s of full braking.
  kinematics::DriveState brake(double dt_s) const;

  /// Moves the body by the present twist unless that would press it deeper into something.
  void move(double dt_s, const Surroundings& around);

  Parameters parameters_;
  geometry::Pose2 base_in_map_;
  kinematics::DriveState drive_;
  geometry::Twist2 wanted_;  // the command in force
  Hindrance hindrance_;
  std::deque<Queued> queued_;
  bool commanded_{false};

  time::Stamp last_command_{};
  bool started_{false};
  time::Stamp time_{};
  Hold hold_{Hold::kNoCommand};
  std::uint64_t contacts_{0};
};

/// The pose that the vehicle believes: `base_in_map` with normal errors of pose_noise_m an axis and yaw_noise_rad.
geometry::Pose2 with_noise(const geometry::Pose2& base_in_map, const Parameters& parameters, std::mt19937_64& random);

}  // namespace aisle::fake_vehicle
