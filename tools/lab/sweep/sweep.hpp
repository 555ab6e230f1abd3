#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/lab/parameters/parameter_values.hpp"
#include "tools/lab/planning/subject.hpp"

namespace aisle::lab {

/// A parameter and the values that it takes in turn.
struct Variation {
  NamedParameter parameter;
  std::vector<std::string> values;
};

/// A grid of trials: everything that is listed, in every combination. Each path is planned, or each drive driven, once
/// for each combination; a planner takes part with its own parameters only.
struct Sweep {
  bool drives{false};  // else paths are planned

  // Where: at least one of these.
  std::vector<SubjectOrders> maps;     // files
  std::vector<std::string> kinds;      // of the papers' maps, drawn by seed (planning/paper_maps.hpp)
  std::vector<std::string> scenarios;  // files or families, driven only

  std::vector<std::string> planners;        // global
  std::vector<std::string> locals{"wang"};  // drives only
  std::vector<std::uint64_t> seeds{1};      // of drives and of kinds
  std::vector<ParameterValue> set;          // in every trial
  std::vector<Variation> vary;

  double radius_m{0.0};           // of the vehicle with its margin, for paths
  double safe_distance_m{0.0};    // of qu and yu, for paths
  double vehicle_radius_m{0.35};  // of drives over maps and kinds
  bool as_printed{false};
  bool paper_limits{false};
};

/// One combination. `subject` counts maps, then kinds, then scenarios.
struct Trial {
  std::size_t index{0};  // its place in the sweep
  std::size_t subject{0};
  std::size_t query{0};  // of a map with several
  std::uint64_t seed{1};
  std::string planner;
  std::string local;                   // empty: a path is planned
  std::vector<ParameterValue> values;  // of the parameters that vary for these planners, in the order of the sweep
};

/// All trials in order: subjects, their queries, seeds, planners, local planners, then values, the last parameter
/// fastest. `queries` has the number of queries of each subject.
/// @throws config::BadInput for more than 10,000,000, before memory is taken for them
std::vector<Trial> trials_of(const Sweep& sweep, const std::vector<std::size_t>& queries);

/// The name of a subject as in result files: the map's file, the kind, or the scenario.
std::string subject_name(const Sweep& sweep, std::size_t subject);
std::size_t subject_count(const Sweep& sweep);

/// @throws config::BadInput with what is missing, unknown, given twice, or would change nothing, and what to do
void check(const Sweep& sweep);

/// "1-3,7": the seeds 1, 2, 3 and 7. @throws config::BadInput, beginning with `flag`
std::vector<std::uint64_t> parse_seeds(const std::string& flag, const std::string& text);

/// "wang.alpha=0.05/0.1/0.2". @throws config::BadInput, beginning with `flag`; every value is checked
Variation parse_variation(const std::string& flag, const std::string& text, std::optional<Side> only = {});

/// Reads a sweep from YAML; the keys are those of the command's flags (tools/lab/README.md has one). Map files are
/// relative to the file.
/// @throws config::BadInput with file and line
Sweep read_sweep(const std::filesystem::path& file);

}  // namespace aisle::lab
