#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tools/lab/page/progress.hpp"
#include "tools/lab/papers/published.hpp"

namespace aisle::lab {

/// What a paper's drive meets, on maps of one kind.
struct DriveScene {
  const char* name;
  const char* map;    // kind, planning/paper_maps.hpp
  const char* paper;  // its global and local planner, and its limits
  int movers;
  int hidden_boxes;
};
const std::vector<DriveScene>& drive_scenes();
/// @throws std::logic_error when there is none of this name
const DriveScene& scene_named(const std::string& name);

/// Which drives: on the maps of seeds (seed - 1) * drives + 1 to seed * drives of each kind.
struct DriveDraw {
  int drives{30};
  unsigned seed{1};
  unsigned first() const { return (seed - 1) * static_cast<unsigned>(drives) + 1; }
};

/// One drive, or one path that is taken as driven.
struct DriveOutcome {
  bool arrived{false};
  bool touched{false};
  bool met_a_mover{false};
  std::map<DriveFigure, double> figures;
  double elsewhere_mps{0.0};    // the reference of kSpeedNearMover
  double elsewhere_radps{0.0};  // of kTurnNearMover
};

/// Drives of contestants over a scene's maps, made when they are asked for. Contestants: "improved" (the paper's path
/// and its critics), "improved-traditional" (the paper's path, the traditional critics), "astar" (the path of an A*
/// that cuts no corner, the traditional critics), "astar-own" (that path, the paper's critics), "dwa" (the traditional
/// critics straight at the goal), and the bare paths "improved-plan" and "traditional-plan".
class DriveMeasurements {
 public:
  DriveMeasurements(const DriveDraw& draw, Progress progress);
  ~DriveMeasurements();
  DriveMeasurements(const DriveMeasurements&) = delete;
  DriveMeasurements& operator=(const DriveMeasurements&) = delete;

  /// One a map. @pre there are such a scene and contestant
  const std::vector<DriveOutcome>& of(const std::string& scene, const std::string& contestant);

 private:
  std::vector<DriveOutcome> measure(const DriveScene& scene, const std::string& contestant);

  DriveDraw draw_;
  Progress progress_;
  std::filesystem::path maps_;  // where the drawn maps lie while this lives
  std::map<std::pair<std::string, std::string>, std::vector<DriveOutcome>> measured_;
};

}  // namespace aisle::lab
