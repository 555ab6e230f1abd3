#pragma once
#include <string>
#include <vector>

#include "common/config/reader.hpp"

namespace YAML {
class Node;
}

namespace aisle::config {

/// Fills structs from YAML, strictly. A struct names its fields once, in `template <class Reader> void describe(Reader& r)`:
///   r.field("max_speed_mps", max_speed_mps, 0.05, 10.0).field("planner", planner).section("limits", limits);
/// A key missing keeps its default; a key unknown, given twice, of another type or out of its bounds throws BadInput with
/// file:line, the key's path, the value, the limit, and for an unknown key the nearest name.
class YamlReader {
 public:
  YamlReader& field(const char* key, double& value, double low, double high);
  YamlReader& field(const char* key, int& value, int low, int high);
  YamlReader& field(const char* key, bool& value);
  YamlReader& field(const char* key, std::string& value);
  YamlReader& field(const char* key, std::vector<std::string>& values);
  template <class T>
  YamlReader& section(const char* key, T& value);            // a nested struct with describe()
  template <class T>
  YamlReader& list(const char* key, std::vector<T>& values);  // a sequence of such structs
};

/// @throws BadInput also for a file that is missing, too large (4 MiB), not YAML, or that nests or aliases without end.
template <class T>
void read_yaml_file(const std::string& file, T& value);

}  // namespace aisle::config
