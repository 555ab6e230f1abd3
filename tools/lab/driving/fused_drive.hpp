#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "services/local-planner/core/critic.hpp"
#include "tools/lab/driving/encounters.hpp"
#include "tools/sim/result.hpp"

namespace aisle::lab {

/// One vehicle, as in the local planner's paper, from S to T of a paper's map, cells of 1 m.
struct FusedDrive {
  std::string map;     // deploy/experiments/<map>.txt
  std::string global;  // of the global planner's variants
  local_planner::Variant local;
  local_planner::PaperLimits limits;  // of the paper that is compared, with every planner
  Surprises surprises;
  bool slows_on_the_way{true};  // by our profile of the way; false: by the critics alone
};

/// A moment of a drive, as commanded.
struct DrivePoint {
  double t_s{0.0};  // since the goal was given
  geometry::Pose2 base_in_map;
  double linear_mps{0.0};
  double angular_radps{0.0};
  double gap_m{1e9};        // from the outline to walls and boxes
  double mover_gap_m{1e9};  // between the outlines, from the nearest mover
  double box_gap_m{1e9};    // from the outline to the nearest box
};

/// So near, between the outlines, a mover or box has to be reacted to: a drive that came nowhere so near met nothing.
inline constexpr double kMetWithinM = 1.5;

struct DriveFigures {
  sim::Result result;
  std::vector<DrivePoint> points;  // from the goal being given to its end (result.driven_s), ten a second
  int movers{0};                   // on this map
  Encounters encounters{};         // all that there was on this map
  /// Between the outlines, while the vehicle drove; a mover that stops for nobody comes nearer to one that stands.
  double nearest_mover_m() const { return nearest_m(&DrivePoint::mover_gap_m); }
  /// Did the driving vehicle come nearer than kMetWithinM to a mover, to a box?
  bool met_a_mover() const { return nearest_mover_m() < kMetWithinM; }
  bool met_a_box() const { return nearest_m(&DrivePoint::box_gap_m) < kMetWithinM; }
  /// Did it meet a mover where movers were asked for, and a box where boxes were? A kind of which the map had no place
  /// for any cannot be met and is not needed; where nothing at all was placed, nothing was met.
  bool met(const Surprises& asked) const;
  bool arrived() const { return result.goals_reached == result.goals_assigned; }
  /// Sums of all changes, up and down: m/s and rad/s.
  double changes_of_v() const;
  double changes_of_w() const;
  double greatest_change_of_w() const;  // within a tenth of a second
  /// Mean speed where walls or boxes are nearer to the outline than this; 0: it never was there.
  double mean_speed_near(double gap_m) const;

 private:
  double nearest_m(double DrivePoint::*gap_m) const;
};

/// The traditional critics along a path: what the papers call A* fused with DWA.
local_planner::Variant traditional_with_path();
/// The same without one: drives at the goal.
local_planner::Variant traditional_alone();
/// A paper's own critics straight at the goal, without a path.
local_planner::Variant paper_critics_alone(const std::string& name);
/// A paper's own local planner. @pre there is one
local_planner::Variant paper_variant(const std::string& name);

/// What the paper puts there is met at encounters_of_paper. @throws config::BadInput when the map cannot be read
DriveFigures drive_fused(const FusedDrive& drive, const std::filesystem::path& maps);

/// The same on a map in memory, with what is given; `drive.map` and `drive.surprises` are not looked at. May be called
/// from several threads.
DriveFigures drive_fused(const FusedDrive& drive, const DrawnMap& map, const Encounters& encounters);

}  // namespace aisle::lab
