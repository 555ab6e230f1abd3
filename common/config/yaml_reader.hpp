#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config/reader.hpp"

namespace YAML {
class Node;
}

namespace aisle::config {

/// Fills structs from YAML, strictly. A struct names its fields once, in `template <class Reader> void describe(Reader&
/// r)`:
///   r.field("max_speed_mps", max_speed_mps, 0.05, 10.0).field("planner", planner).section("limits", limits);
/// A key missing keeps its default (unless `require`d); a key unknown, given twice, of another type or out of its
/// bounds throws BadInput with file:line, the key's path, the value, the limit, and for an unknown key the nearest
/// name. Bounds are inclusive; numbers are plain decimals, never NaN or infinite; yes and no are not booleans, true and
/// false are.
class YamlReader {
 public:
  YamlReader(YamlReader&&) noexcept;
  YamlReader& operator=(YamlReader&&) noexcept;
  ~YamlReader();

  /// One key each; bounds are inclusive.
  YamlReader& field(const char* key, double& value, double low, double high);
  YamlReader& field(const char* key, int& value, int low, int high);
  YamlReader& field(const char* key, std::uint64_t& value, std::uint64_t low, std::uint64_t high);
  YamlReader& field(const char* key, bool& value);
  YamlReader& field(const char* key, std::string& value);
  YamlReader& field(const char* key, std::vector<std::string>& values);

  /// [1.0, 2.5]
  YamlReader& field(const char* key, std::vector<double>& values, double low, double high);

  /// [[1.0, 2.5], [3.0, 4.0, 0.5]]: rows may differ in length.
  YamlReader& field(const char* key, std::vector<std::vector<double>>& rows, double low, double high);

  /// A nested struct with describe().
  template <class T>
  YamlReader& section(const char* key, T& value);

  /// A sequence of such structs; replaces what `values` held.
  template <class T>
  YamlReader& list(const char* key, std::vector<T>& values);

  /// The keys must be there.
  YamlReader& require(const std::vector<std::string>& keys);

  /// Is the key in the file?
  bool has(const char* key) const;

  /// "file:line: path.to.key", of this section when the key is not there; for checks that need more than one field.
  std::string where(const char* key) const;

  /// Throws BadInput "where(key): why".
  [[noreturn]] void reject(const char* key, const std::string& why) const;

  /// Throws for keys that describe() did not name, then for required ones that are not there. Called by whoever called
  /// describe().
  void finish() const;

 private:
  struct State;

  explicit YamlReader(std::unique_ptr<State> state);

  /// The section, and the sections of a list, under `key`; none when the key is not there.
  std::optional<YamlReader> open(const char* key);
  std::optional<std::vector<YamlReader>> open_list(const char* key);

  std::unique_ptr<State> state_;

  friend YamlReader open_yaml_text(const std::string& text, const std::string& name);
};

/// `name` stands for the file in errors. @throws BadInput as read_yaml_file
YamlReader open_yaml_text(const std::string& text, const std::string& name);
YamlReader open_yaml_file(const std::filesystem::path& file);

/// @throws BadInput also for a file that is missing, larger than 4 MiB, not YAML, of more than one document, nested
/// deeper than 32 levels, or with anchors and aliases (which can make a small file huge).
template <class T>
void read_yaml_file(const std::filesystem::path& file, T& value) {
  YamlReader reader = open_yaml_file(file);
  value.describe(reader);
  reader.finish();
}

/// As read_yaml_file, from a string.
template <class T>
void read_yaml_text(const std::string& text, const std::string& name, T& value) {
  YamlReader reader = open_yaml_text(text, name);
  value.describe(reader);
  reader.finish();
}

template <class T>
YamlReader& YamlReader::section(const char* key, T& value) {
  if (std::optional<YamlReader> child = open(key)) {
    value.describe(*child);
    child->finish();
  }

  return *this;
}

template <class T>
YamlReader& YamlReader::list(const char* key, std::vector<T>& values) {
  if (std::optional<std::vector<YamlReader>> children = open_list(key)) {
    values.clear();

    for (YamlReader& child : *children) {
      T value;
      value.describe(child);
      child.finish();
      values.push_back(std::move(value));
    }
  }

  return *this;
}

}  // namespace aisle::config
