#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::referee {

/// Of a goal that was given.
enum class GoalOutcome { kOpen, kReached, kFailed, kCancelled };

/// A goal and what became of it. Times in seconds since the start of the run.
struct GoalRecord {
  std::string agv_id;
  std::string goal_id;
  geometry::Pose2 pose_in_map;
  double position_tolerance_m{0.0};
  double assigned_s{0.0};
  double decided_s{-1.0};
  double failing_since_s{-1.0};  // its vehicle has reported failure since then; less than 0: it does not
  GoalOutcome outcome{GoalOutcome::kOpen};
  std::string reason;  // why it is not reached, as far as anyone said
};

/// What a local planner says of its vehicle's goal.
struct GoalNews {
  enum class Phase { kOther, kArrived, kFailed };

  std::string agv_id;
  std::string goal_id;
  Phase phase{Phase::kOther};
  std::string reason;  // "blocked: vehicle agv-2", kept for the report
  double t_s{0.0};
};

/// Which goals were given and what became of them. A vehicle's claim to have arrived counts only where
/// ground truth has the vehicle within the goal's tolerance plus kSlack_m (for localisation and
/// braking). A goal that was replaced by another before it was reached has failed.
class GoalBook {
 public:
  /// A goal was given, given again, or cancelled.
  void assigned(const GoalRecord& goal, bool cancelled);

  /// `true_base_in_map`: of ground truth.
  void heard(const GoalNews& news, const geometry::Pose2& true_base_in_map);

  /// Nothing more will come: what is open has failed.
  void close(double t_s);

  /// The open goal of this vehicle, or null.
  const GoalRecord* open_goal(const std::string& agv_id) const;

  /// In the order in which they were given.
  std::vector<GoalRecord> all() const { return goals_; }
  int count(GoalOutcome outcome) const;
  int assigned_count(const std::string& agv_id) const;
  int assigned_count() const { return static_cast<int>(goals_.size()); }

  static constexpr double kSlack_m = 0.15;

 private:
  GoalRecord* newest_of(const std::string& agv_id);

  std::vector<GoalRecord> goals_;              // in the order they were given
  std::map<std::string, std::size_t> newest_;  // of each vehicle
};

const char* name_of(GoalOutcome outcome);

}  // namespace aisle::referee
