#pragma once
#include <optional>

#include "common/geometry/pose.hpp"
#include "common/kinematics/limits.hpp"

namespace aisle::local_planner {

struct TargetQuestion;
struct PrintedTarget;

/// What a paper's dynamic window aims at. Values in, values out; one rule a paper, in core/printed/target_rules/.
using TargetRule = PrintedTarget (*)(const TargetQuestion& question);

/// The rules of the papers; target_rule.hpp has what they take and give.
namespace target_rules {

/// The traditional dynamic window: the goal, whatever lies between.
PrintedTarget goal(const TargetQuestion& question);
/// LI, section IV.C and eq. 10: the goal, and as sub-goal G_i for Yheading the nearest point of the global path.
PrintedTarget nearest_path_point(const TargetQuestion& question);
/// QU, section 4: the key points of the path are intermediate targets; YU, section 3.2 and conclusion (2): the points
/// of the path are sub-targets. One after the other.
PrintedTarget path_nodes(const TargetQuestion& question);
/// WANG, section 4 (3) and (4): the critical turning points are temporary targets, one after the other.
PrintedTarget turning_points(const TargetQuestion& question);
/// WU, sections 4.2, 4.3 and 5, eq. 13: the local sub-target while a collision is predicted; else the global path is
/// followed without a dynamic window.
PrintedTarget local_sub_target(const TargetQuestion& question);

}  // namespace target_rules

/// How a paper's vehicle drives by its local planner, beside critics, weights and `PaperLimits`. What a paper does not
/// print is chosen, and the field says so.
struct AsPrinted {
  TargetRule target_rule{target_rules::goal};
  kinematics::Model model{kinematics::Model::kDifferential};  // all but WU sample (v, w) alone: a unicycle
  std::optional<double> start_yaw_rad{};                      // initial azimuth; none printed: towards the goal
  bool faces_first_node{false};  // YU eq. 12: turns to the path's first node before it drives

  double interval_s{0.1};        // dt, of a choice and of its window V_d: WU, QU; chosen for the others
  double linear_step_mps{0.01};  // resolution of v: QU, WANG; chosen for LI, YU, WU
  double angular_step_radps{geometry::kPi / 180.0};  // resolution of w: QU, WANG; chosen for LI, YU, WU

  // Not printed by any of them.
  double next_target_m{1.0};    // from here on a target is reached and the next is aimed at: a cell of their maps
  double path_step_m{1.0};      // between the path's points that LI's sub-goal is one of: a cell
  double path_ahead_m{1.5};     // WU: the path is followed by a point so far ahead on it
  double clearance_cap_m{0.2};  // more room than this at walls earns nothing, as in our own drive
  double mover_cap_m{0.6};      // the same from things that move or stand
  double radius_m{0.2};         // of the vehicle's disc; the papers draw a point
};

}  // namespace aisle::local_planner
