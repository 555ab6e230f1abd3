#include "common/scenario/data_path.hpp"

#include <cstdlib>
#include <vector>

#include "common/config/reader.hpp"

namespace aisle::scenario {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDataPrefix = "data:";

/// False also when it cannot be looked at.
bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// Folders that may hold the data, best first. A scenario file lies two folders below the top of its tree.
std::vector<fs::path> data_folders(const fs::path& scenario_file) {
  const char* set = std::getenv("AISLE_DATA");
  if (set != nullptr && *set != '\0') return {fs::path(set)};
  const fs::path tree = fs::absolute(scenario_file).lexically_normal().parent_path().parent_path().parent_path();
  return {(tree / "../shared/data").lexically_normal(), (fs::current_path() / "../shared/data").lexically_normal()};
}

/// Within the data folders only: names with .. are refused.
fs::path find_data(const std::string& name, const fs::path& scenario_file) {
  const fs::path relative = fs::path(name).lexically_normal();
  if (relative.is_absolute() || (!relative.empty() && *relative.begin() == "..")) {
    throw config::BadInput(scenario_file.string() + ": '" + kDataPrefix + name +
                           "' leaves the data folder; name a file within it");
  }

  std::string looked;
  for (const fs::path& folder : data_folders(scenario_file)) {
    if (is_file(folder / relative)) return folder / relative;
    looked += (looked.empty() ? "" : ", ") + folder.string();
  }

  throw config::BadInput(scenario_file.string() + ": no file '" + name + "' in " + looked +
                         "; set AISLE_DATA to the folder with the reference data (ros, movingai, pedestrians)");
}

}  // namespace

/// The prefix decides where a name is looked for.
fs::path find_named_file(const std::string& name, const fs::path& scenario_file) {
  const std::string prefix = kDataPrefix;
  if (name.compare(0, prefix.size(), prefix) == 0) return find_data(name.substr(prefix.size()), scenario_file);

  const fs::path path = (scenario_file.parent_path() / name).lexically_normal();
  if (!is_file(path)) {
    throw config::BadInput(scenario_file.string() + ": no file '" + path.string() +
                           "'; paths are relative to the scenario file");
  }

  return path;
}

}  // namespace aisle::scenario
