#include <fmt/format.h>

#include "common/config/reader.hpp"
#include "common/config/yaml_reader.hpp"
#include "tools/lab/sweep/sweep.hpp"

namespace aisle::lab {
namespace {

/// Runs `read`, whose refusals begin with the key, and puts the file and line before them.
template <class Reader, class Read>
auto at(Reader& r, const char* key, const Read& read) {
  try {
    return read();
  } catch (const config::BadInput& error) {
    const std::string why = error.what(), head = std::string(key) + ": ";
    r.reject(key, why.rfind(head, 0) == 0 ? why.substr(head.size()) : why);
  }
}

/// A map of the file, `{file: hall.png, resolution_m: 0.05, start: [1, 1], goal: [9, 7]}`.
struct MapEntry {
  std::string file;
  double resolution_m{0.0};
  std::vector<double> start, goal;
  std::string scen;
  int limit{1'000'000};

  template <class Reader>
  void describe(Reader& r) {
    r.field("file", file)
        .field("resolution_m", resolution_m, 0.001, 1000.0)
        .field("start", start, -1e6, 1e6)
        .field("goal", goal, -1e6, 1e6)
        .field("scen", scen)
        .field("limit", limit, 1, 1'000'000)
        .require({"file"});
    for (const char* key : {"start", "goal"})
      if (r.has(key) && !is_place(key == std::string("start") ? start : goal))
        r.reject(key, "must be [X, Y] or [X, Y, YAW]");
  }

  static bool is_place(const std::vector<double>& numbers) { return numbers.size() == 2 || numbers.size() == 3; }

  static std::optional<Place> place_of(const std::vector<double>& numbers) {
    if (numbers.empty()) return std::nullopt;
    return Place{{numbers[0], numbers[1]}, numbers.size() == 3 ? std::optional(numbers[2]) : std::nullopt};
  }

  SubjectOrders orders(const std::filesystem::path& folder) const {
    const auto beside = [&](const std::string& name) {
      return name.empty() || std::filesystem::path(name).is_absolute() ? std::filesystem::path(name) : folder / name;
    };
    return {beside(file), resolution_m, place_of(start), place_of(goal), beside(scen), static_cast<std::size_t>(limit)};
  }
};

/// A parameter with the values that it takes in turn.
struct VariationEntry {
  std::string parameter;
  std::vector<std::string> values;

  template <class Reader>
  void describe(Reader& r) {
    r.field("parameter", parameter).field("values", values).require({"parameter", "values"});
    if (r.has("values") && values.empty()) r.reject("values", "is empty: give at least one");
  }
};

/// The whole file.
struct SweepFile {
  Sweep sweep;
  std::vector<MapEntry> maps;

  template <class Reader>
  void describe(Reader& r) {
    std::string seeds;
    std::vector<std::string> sets;
    std::vector<VariationEntry> vary;

    r.field("drive", sweep.drives)
        .list("maps", maps)
        .field("kinds", sweep.kinds)
        .field("scenarios", sweep.scenarios)
        .field("planners", sweep.planners)
        .field("locals", sweep.locals)
        .field("seeds", seeds)
        .field("set", sets)
        .list("vary", vary)
        .field("radius_m", sweep.radius_m, 0.0, 100.0)
        .field("safe_distance_m", sweep.safe_distance_m, 0.0, 100.0)
        .field("vehicle_radius_m", sweep.vehicle_radius_m, 0.01, 100.0)
        .field("as_printed", sweep.as_printed)
        .field("paper_limits", sweep.paper_limits);

    const std::optional<Side> only = sweep.drives ? std::nullopt : std::optional(Side::kGlobal);
    if (r.has("seeds")) sweep.seeds = at(r, "seeds", [&] { return parse_seeds("seeds", seeds); });
    for (const std::string& text : sets)
      sweep.set.push_back(at(r, "set", [&] { return parse_parameter("set", text, only); }));
    for (const VariationEntry& entry : vary)
      sweep.vary.push_back(at(r, "vary", [&] {
        return parse_variation("vary", fmt::format("{}={}", entry.parameter, fmt::join(entry.values, "/")), only);
      }));
  }
};

}  // namespace

Sweep read_sweep(const std::filesystem::path& file) {
  SweepFile read;
  config::read_yaml_file(file, read);
  for (const MapEntry& entry : read.maps) read.sweep.maps.push_back(entry.orders(file.parent_path()));
  return read.sweep;
}

}  // namespace aisle::lab
