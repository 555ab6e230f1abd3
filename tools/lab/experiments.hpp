#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "tools/lab/driving/local_experiment.hpp"
#include "tools/lab/page/progress.hpp"
#include "tools/lab/papers/papers_section.hpp"
#include "tools/lab/planning/global_experiment.hpp"
#include "tools/lab/tracking/tracking_experiment.hpp"

namespace aisle::lab {

/// Where docs/experiments.md lies and what its sections are made from.
struct Experiments {
  std::filesystem::path page{"docs/experiments.md"};  // pictures go to experiments/ beside it
  std::filesystem::path maps{"deploy/experiments"};   // of the papers; beside them the reference data is looked for
  PapersExperiment papers;
  GlobalExperiment global;  // places are filled in from the two above, those of all four
  LocalExperiment local;
  TrackingExperiment tracking;
};

enum class Section { kPapers, kGlobalPlanning, kLocalPlanning, kObstacleTracking };

/// Runs one experiment, which takes minutes, and writes its section of the page anew; the others stay as they are.
/// Returns the sentences that were left out because the figures do not bear them out.
/// @throws config::BadInput, config::BadEnvironment
std::vector<std::string> write_section(const Experiments& experiments, Section section, const Progress& progress);

/// Runs all experiments and writes the whole page; nothing of the page before is kept. Returns as write_section.
/// @throws config::BadEnvironment when the reference data is missing: then a part would be lost
std::vector<std::string> write_page(const Experiments& experiments, const Progress& progress);

}  // namespace aisle::lab
