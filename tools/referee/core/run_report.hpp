#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/referee/core/authority_watch.hpp"
#include "tools/referee/core/contact_watch.hpp"
#include "tools/referee/core/distribution.hpp"
#include "tools/referee/core/drive_book.hpp"
#include "tools/referee/core/goal_book.hpp"

namespace aisle::referee {

/// One plan as it was drawn: for the picture.
struct PlanTrace {
  double t_s{0.0};
  std::vector<geometry::Point2> waypoints_in_map;
};

/// Everything of one vehicle.
struct VehicleRow {
  std::string agv_id;
  Shape shape;
  double ahead_m{0.0};  // of the shape's middle before the vehicle's base
  DriveBook drive;
  std::vector<PlanTrace> plans;
  int replans{0};
  std::uint64_t refused_commands{0};
  Distribution command_gap_ms;
  Distribution scan_to_command_ms;
  double truth_gap_ms_max{0.0};  // between two samples of ground truth
};

/// The way of a person, or the place of a block.
struct BodyTrace {
  BodyKind kind{BodyKind::kPerson};
  Shape shape;
  std::vector<std::pair<double, geometry::Pose2>> way;  // seconds, pose; a block has one
};

/// A map edit that was asked for, and what the map said.
struct EditRow {
  std::string edit_id;
  bool block{true};
  std::vector<geometry::Point2> outline_in_map;  // of a disc: points on it
  std::int64_t asked_stamp_ns{0};                // when it was written
  double asked_s{0.0};
  double answered_s{-1.0};
  std::string outcome;  // "applied", "refused: ..."; empty: no answer
  std::uint64_t revision{0};
};

/// What one process took, from its own service_health.
struct ServiceRow {
  std::string instance;
  std::string service;
  int starts{0};  // 1, and one more for each restart
  double cpu_percent_sum{0.0};
  int cpu_samples{0};
  double resident_mb_max{0.0};

  double cpu_percent_mean() const { return cpu_samples > 0 ? cpu_percent_sum / cpu_samples : 0.0; }
};

/// Everything that is known of a run: report.json and the pictures are made of it.
struct RunReport {
  std::string scenario;
  std::uint64_t seed{0};
  double duration_s{0.0};
  int goals_expected{0};  // by the scenario; those never given count as missed
  std::vector<GoalRecord> goals;
  std::vector<Contact> contacts;
  Clearances clearances;
  std::vector<AuthorityViolation> violations;
  std::map<std::string, VehicleRow> vehicles;
  std::map<std::string, BodyTrace> bodies;  // persons and blocks
  std::vector<EditRow> edits;
  std::map<std::string, ServiceRow> services;
  Distribution planning_ms;
  Distribution control_ms;
  Distribution map_edit_to_plan_ms;
  std::string ended_because;
  double person_clearance_m{0.0};  // that the scenario asks for

  /// False where people are recordings: these walk into vehicles that stand, which is not held against the vehicles.
  bool people_give_way{true};

  int count(GoalOutcome outcome) const;

  /// Expected, but neither reached nor cancelled.
  int goals_missed() const;
  int contacts_moving_vehicle() const;

  /// Sums and distributions over all vehicles.
  double distance_m() const;
  int stops() const;
  int replans() const;
  Distribution command_gap_ms() const;
  Distribution scan_to_command_ms() const;
  double cpu_percent_total() const;  // of the services, not of the referee

  /// Did a vehicle and a person come nearer than the scenario allows?
  bool came_too_near() const;

  /// Why a run did not pass: one line, with its second, for each contact, violation and missed goal.
  std::vector<std::string> troubles() const;

  /// Every goal reached, nothing touched, no person passed too near, no vehicle followed a command that
  /// it should refuse.
  bool passed() const;
};

}  // namespace aisle::referee
