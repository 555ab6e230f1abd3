#pragma once
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tools/lab/driving/encounters.hpp"
#include "tools/lab/page/progress.hpp"
#include "tools/lab/papers/published.hpp"

namespace aisle::lab {

/// What a paper's drive meets, on maps of one kind.
struct DriveScene {
  const char* name;
  const char* map;    // kind, planning/paper_maps.hpp
  const char* paper;  // its global and local planner, and its limits
  Surprises surprises;
};
const std::vector<DriveScene>& drive_scenes();
/// @throws std::logic_error when there is none of this name
const DriveScene& scene_named(const std::string& name);

/// Which drives: on the maps of seeds (seed - 1) * drives + 1 to seed * drives of each kind.
struct DriveDraw {
  int drives{30};
  unsigned seed{1};
  int threads{2};  // that drive at the same time; the figures do not depend on it
  unsigned first() const { return (seed - 1) * static_cast<unsigned>(drives) + 1; }
};

/// One drive, or one path that is taken as driven.
struct DriveOutcome {
  bool arrived{false};
  bool touched{false};
  /// A mover in a scene with movers and a box in one with boxes, as far as the map had a place for them
  /// (DriveFigures::met); true in a scene with neither.
  bool met_what_is_there{false};
  std::map<DriveFigure, double> figures;
  double elsewhere_mps{0.0};    // the reference of kSpeedNearMover
  double elsewhere_radps{0.0};  // of kTurnNearMover
};

/// Drives of contestants over a scene's maps, made when they are asked for. What they meet stands and moves at places
/// and times of the map, the same for all of them (encounters_on). Contestants:
///
///   improved              the paper's path, the paper's critics
///   improved-traditional  the paper's path, the traditional critics
///   astar                 the path of an A* that cuts no corner, the traditional critics
///   astar-own             that path, the paper's critics: differs from `improved` in the path alone
///   dwa                   no path, straight at the goal, the traditional critics
///   dwa-own               the same with the paper's critics
///   improved-blind        the paper's path at nominal_speed_mps, whatever is in the way
///   improved-plan         the bare path of the paper
///   traditional-plan      the bare path of the traditional A*, which may cut corners
///
/// A name with "-by-critics" behind it: without our own slowing before bends and walls, which slows all contestants
/// alike.
class DriveMeasurements {
 public:
  DriveMeasurements(const DriveDraw& draw, Progress progress);

  /// One a map. @pre there are such a scene and contestant
  const std::vector<DriveOutcome>& of(const std::string& scene, const std::string& contestant);

 private:
  std::vector<DriveOutcome> measure(const DriveScene& scene, const std::string& contestant);

  DriveDraw draw_;
  Progress progress_;
  std::map<std::pair<std::string, std::string>, std::vector<DriveOutcome>> measured_;
};

}  // namespace aisle::lab
