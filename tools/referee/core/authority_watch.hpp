#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace aisle::referee {

/// What a vehicle says about itself and about the command that it follows. Empty command_agv_id: it has
/// followed none.
struct VehicleReport {
  std::string agv_id;
  std::uint64_t boot_id{0};
  double t_s{0.0};
  double speed_mps{0.0};
  bool holds{false};  // brakes by itself, follows no command
  std::string command_agv_id;
  std::string command_source;
  std::uint64_t command_boot{0};
  std::uint32_t command_epoch{0};
  std::uint64_t command_sequence{0};
  std::uint64_t command_plan_id{0};
};

/// A vehicle followed a command that it should have refused.
struct AuthorityViolation {
  enum class Kind {
    kForeignVehicle,
    kEpochWentBack,
    kSequenceWentBack,
    kStalePlan,
    kBeyondGrant,
    kFloorHeldTwice,
    kZoneBreached
  };

  Kind kind;
  std::string agv_id;
  double t_s;
  std::string text;
};

/// Checks that vehicles follow only commands that they may follow. Violations are:
///
///   - a command for another vehicle;
///   - an epoch lower than one followed before;
///   - an older command of the same sender than one followed before;
///   - driving by a plan although its own status has named the newest one for more than kGrace_s, or kBrakingGrace_s
///   where that is a refusal; or by no plan for that long (the vehicle may brake). A vehicle that cannot have heard of
///   the newest plan may go on by the one before: how far, GrantWatch knows.
///
/// A vehicle that holds follows no command. Each kind is reported once until it ends. A vehicle that
/// restarts begins anew.
class AuthorityWatch {
 public:
  /// `plan_id` is the newest for this vehicle; `drivable`: a path was found.
  void plan_arrived(const std::string& agv_id, std::uint64_t plan_id, bool drivable, double t_s);

  /// The vehicle's own status names the plan.
  void plan_named(const std::string& agv_id, std::uint64_t plan_id, double t_s);

  /// Reports of one vehicle in the order of their arrival.
  void vehicle_reported(const VehicleReport& report);

  /// In the order in which they began.
  const std::vector<AuthorityViolation>& violations() const { return violations_; }

  static constexpr double kGrace_s = 0.5;
  static constexpr double kBrakingGrace_s = 2.0;
  static constexpr double kMoving_mps = 0.05;

 private:
  /// What is known of one vehicle: the highest epoch, the last command, the newest plan.
  struct Followed {
    bool reported{false};
    std::uint64_t boot_id{0};
    std::uint32_t highest_epoch{0};
    std::string source;
    std::uint64_t source_boot{0};
    std::uint32_t epoch{0};
    std::uint64_t sequence{0};
    bool plan_seen{false};
    std::uint64_t plan_id{0};
    bool plan_drivable{false};
    double plan_since_s{0.0};
    std::uint64_t named_plan_id{0};
    double named_since_s{0.0};
    double without_plan_since_s{-1.0};
    std::map<AuthorityViolation::Kind, bool> going_on;
  };

  /// Epoch, and number within a sender.
  void check_order(Followed& vehicle, const VehicleReport& report);

  /// Does it drive by an old plan, or by none?
  void check_plan(Followed& vehicle, const VehicleReport& report);

  /// Notes a violation at its beginning.
  void judge(Followed& vehicle, const VehicleReport& report, AuthorityViolation::Kind kind, bool violated,
             const std::string& text);

  std::map<std::string, Followed> vehicles_;
  std::vector<AuthorityViolation> violations_;
};

/// "stale_plan", for the report.
const char* name_of(AuthorityViolation::Kind kind);

}  // namespace aisle::referee
