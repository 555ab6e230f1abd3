#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/cli/cli.hpp"
#include "tools/lab/parameters/parameter_values.hpp"
#include "tools/lab/planning/subject.hpp"
#include "tools/lab/results/result_text.hpp"

namespace aisle::cli {

// Flags that plan, drive and lab have in common: a researcher's own map, and parameters by name.

/// As typed.
struct MapFlags {
  std::string map, start, goal, scen;
  double resolution_m{0.0};  // 0: not given
  int limit{1'000'000};
};

/// --map, --resolution, --start, --goal, --scen and --limit.
void add_map_flags(Verb& verb, MapFlags& flags);

/// @throws config::BadInput for a place that is none
lab::SubjectOrders subject_orders_of(const MapFlags& flags);

/// A flag by its name, and whether it was typed.
struct Typed {
  const char* flag;
  bool is_given;
};

/// The flags of add_map_flags without --map.
std::vector<Typed> typed_place_flags(const MapFlags& flags);

/// A flag that does not count must not be ignored. @throws config::BadInput, "FLAG: why", for the first that was typed
void refuse_typed(const std::vector<Typed>& flags, const std::string& why);

/// For heads of result files: resolution_m, start, goal, scen and limit as typed; null where not given.
lab::Row head_rows(const MapFlags& flags);

/// As typed.
struct ParameterFlags {
  std::vector<std::string> sets;
  std::string file;
};

/// --set and --parameters.
void add_parameter_flags(Verb& verb, ParameterFlags& flags);

/// The values of the file that count here, then those of --set, which must all count. With `only`, names without a
/// side are of that one. @throws config::BadInput
std::vector<lab::ParameterValue> parameters_of(const ParameterFlags& flags, const lab::InUse& in_use,
                                               std::optional<lab::Side> only = {});

/// "local.wang.alpha=0.1, ..." for heads of result files; empty: all as published.
std::string listed_values(const std::vector<lab::ParameterValue>& values);

}  // namespace aisle::cli
