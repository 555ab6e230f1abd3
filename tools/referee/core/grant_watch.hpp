#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"
#include "tools/referee/core/authority_watch.hpp"

namespace aisle::referee {

/// Checks from ground truth that no vehicle is beyond the road that was granted to it: its place, put on the way of the
/// plan that it drives by, lies no more than kSlackM beyond the farthest limit that was ever published for that plan.
/// (A limit that is taken back counts until the vehicle gives it back, which only it knows.) Plans without steps have
/// no limit. Each violation is reported once until it ends.
class GrantWatch {
 public:
  /// @param has_steps is its way granted step by step?
  void plan_arrived(const std::string& agv_id, std::uint64_t plan_id,
                    const std::vector<geometry::Point2>& waypoints_in_map, bool has_steps);

  void grant_arrived(const std::string& agv_id, std::uint64_t plan_id, double limit_m);

  /// What the vehicle says to obey.
  void vehicle_reported(const VehicleReport& report);

  /// Where it truly is.
  void vehicle_seen(const std::string& agv_id, geometry::Point2 base_in_map, double t_s);

  /// In the order in which they began.
  const std::vector<AuthorityViolation>& violations() const { return violations_; }

  static constexpr double kSlackM = 0.2;  // the pose that it believes, and the place where it comes to stand
  static constexpr double kGraceS = 0.3;  // until the word of a grant has come here, too
  static constexpr double kFirstM = 3.0;  // along a plan, within which it is when it begins to drive by it
  static constexpr double kAheadM = 0.6;  // of where it was on the plan's way
  static constexpr double kTubeM = 0.15;  // so near to a part of the way it may be on it

 private:
  struct GrantedPlan {
    std::vector<geometry::Point2> waypoints_in_map;
    bool has_steps{false};
    bool is_granted{false};
    double limit_m{0.0};
    bool is_begun{false};
    double along_m{0.0};
  };

  struct Followed {
    std::map<std::uint64_t, GrantedPlan> plans;  // the newest few
    std::uint64_t plan_id{0};                    // that it drives by
    double beyond_since_s{-1.0};
    bool is_told{false};
  };

  /// A point of a way: how far along it is, and how far beside it the vehicle is.
  struct Spot {
    double along_m{0.0};
    double beside_m{0.0};
  };

  /// Puts the place on the plan's way. @returns how far along it is
  static double advance(GrantedPlan& plan, geometry::Point2 base_in_map);

  /// The nearest point of the way between where the vehicle was and `most_m` along it.
  static Spot nearest(const GrantedPlan& plan, geometry::Point2 base_in_map, double most_m);

  std::map<std::string, Followed> vehicles_;
  std::vector<AuthorityViolation> violations_;
};

}  // namespace aisle::referee
