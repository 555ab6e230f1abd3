#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/referee/core/closest_approach.hpp"
#include "tools/referee/core/walls.hpp"

namespace aisle::referee {

enum class BodyKind { kVehicle, kPerson, kBlock };

/// Ground truth of one body at one moment: seconds since the start of the run, metres and radians in
/// map.
struct BodySample {
  std::string id;
  BodyKind kind{BodyKind::kVehicle};
  Shape shape;
  geometry::Pose2 base_in_map;
  double speed_mps{0.0};
  double t_s{0.0};
  std::uint64_t boot_id{0};  // of the simulation that says so; where it changes, the body was set down anew
  double ahead_m{0.0};       // of the shape's middle before the base
};

/// The middle of a shape that lies `ahead_m` before its base, with the base's heading.
geometry::Pose2 middle_in_map(const geometry::Pose2& base_in_map, double ahead_m);

/// Which kinds of bodies came near each other.
enum class PairClass { kVehicleVehicle, kVehiclePerson, kVehicleBlock, kVehicleWall };

inline constexpr std::array<PairClass, 4> kPairClasses{PairClass::kVehicleVehicle, PairClass::kVehiclePerson,
                                                       PairClass::kVehicleBlock, PairClass::kVehicleWall};

/// "vehicle_vehicle", "vehicle_person", ...
const char* name_of(PairClass pair);

/// A vehicle with any point faster than this moves.
inline constexpr double kMovingMps = 0.05;

/// One touch of a pair, from its first moment until the two were apart. `b` is "wall" for a wall.
struct Contact {
  PairClass pair{PairClass::kVehicleVehicle};
  std::string a;
  std::string b;
  double begin_s{0.0};
  double end_s{0.0};
  geometry::Point2 at_in_map;      // of a, at the first touch
  double relative_speed_mps{0.0};  // the greatest while they touched
  double vehicle_speed_mps{0.0};   // of the faster vehicle, the greatest while they touched
  double depth_m{0.0};

  /// Contacts of vehicles that stand may be the other's fault.
  bool vehicle_moved() const { return vehicle_speed_mps > kMovingMps; }
};

/// Least clearance so far, in metres; none for a kind of pair that never came within sight of each
/// other.
struct Clearances {
  std::array<std::optional<double>, kPairClasses.size()> least_m;
  std::optional<double> moving_vehicle_m;  // of vehicles that moved then, to anything

  /// Of all kinds of pairs.
  std::optional<double> overall_m() const;
};

/// Finds contacts between vehicles, persons, blocks and walls from ground truth. A person that touches
/// another person or a wall is no vehicle's fault and not looked at.
///
/// Between two samples a body is taken to move straight, whatever their distance, so that nothing slips
/// through between samples. Pairs are compared at common moments, even if their samples have others. A
/// body that falls silent stays where it was (vehicles for good, others for kMemory_s). Touches of one
/// pair that follow each other within kMerge_s are one contact.
class ContactWatch {
 public:
  /// `walls` may be null: then there are none. It must outlive the watch.
  explicit ContactWatch(const Walls* walls);

  /// Samples may come late; one older than another of the same body is ignored.
  void see(const BodySample& sample);

  /// The body does not exist any more.
  void gone(const std::string& id);

  /// Judges everything up to `until_s`; samples for earlier moments that come later count as from then.
  void advance(double until_s);

  const std::vector<Contact>& contacts() const { return contacts_; }
  const Clearances& clearances() const { return clearances_; }

  static constexpr double kMemory_s = 3.0;
  static constexpr double kMerge_s = 0.5;
  static constexpr double kApart_m = 0.02;

 private:
  /// A sample of a body's way: between two of them it moves straight.
  struct Knot {
    double t_s;
    geometry::Pose2 pose;
    double speed_mps;
  };

  /// A body and the part of its way that is not judged yet.
  struct Body {
    BodyKind kind;
    Shape shape;
    std::uint64_t boot_id;
    std::deque<Knot> knots;  // the first is at or before judged_until_s_
    double last_seen_s;
  };

  /// A body's motion between two moments, with the greatest speed in it.
  struct Piece {
    Motion motion;
    double speed_mps;
    double velocity_x_mps;
    double velocity_y_mps;
  };

  struct Moment {
    double begin_s, end_s;
  };

  /// A contact that may still go on: its place in contacts_, and when they last touched.
  struct Touch {
    std::size_t contact;
    double last_s;
  };

  std::vector<double> breaks(const Body& a, const Body* b, double until_s) const;
  static Knot knot_at(const Body& body, double t_s);
  static Piece piece_of(const Body& body, const Moment& moment);

  /// Compares two bodies from judged_until_s_ to `until_s`, moment by moment.
  void judge_pair(const std::string& id_a, const Body& a, const std::string& id_b, const Body& b, double until_s);
  void judge_walls(const std::string& id, const Body& body, double until_s);

  /// Keeps the clearance, and begins or ends a contact.
  void note(PairClass pair, const std::string& id_a, const Piece& a, const std::string& id_b, const Piece* b,
            const Moment& moment, const Approach& approach);

  /// Of the one or two vehicles of the pair.
  static double fastest_vehicle_mps(PairClass pair, const Piece& a, const Piece* b);
  void note_touch(PairClass pair, const std::string& id_a, const Piece& a, const std::string& id_b, const Piece* b,
                  double t_s, double depth_m, double at);

  /// Drops the knots before `until_s`, and bodies silent for too long.
  void forget(double until_s);

  const Walls* walls_;
  double judged_until_s_{-1e18};
  std::map<std::string, Body> bodies_;
  std::map<std::pair<std::string, std::string>, Touch> touches_;
  std::vector<Contact> contacts_;
  Clearances clearances_;
};

}  // namespace aisle::referee
