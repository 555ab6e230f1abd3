#include "common/config/yaml_reader.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "common/config/nearest_name.hpp"
#include "common/config/yaml_guard.hpp"

namespace aisle::config {
namespace {

/// "file:line", or the file alone where the line is unknown.
std::string location(const std::string& file, const YAML::Mark& mark) {
  return mark.line < 0 ? file : file + ":" + std::to_string(mark.line + 1);
}

/// A bound, as a person would write it.
template <class Number>
std::string text_of(Number number) {
  std::ostringstream out;
  out << number;
  return out.str();
}

const char* kind_of(const YAML::Node& node) {
  if (node.IsMap()) return "a section";
  if (node.IsSequence()) return "a list";
  return node.IsNull() ? "empty" : "text";
}

/// The value in quotes, cut to 60 characters; for lists and sections, their kind.
std::string shown(const YAML::Node& node) {
  constexpr std::size_t kLongest = 60;
  if (!node.IsScalar()) return kind_of(node);
  const std::string& text = node.Scalar();
  return "'" + (text.size() > kLongest ? text.substr(0, kLongest) + "..." : text) + "'";
}

/// yaml-cpp gives quoted text the tag "!".
bool is_quoted(const YAML::Node& node) { return node.Tag() == "!"; }

}  // namespace

/// One section of a file: its entries, which keys describe() has named so far, and which must be there.
struct YamlReader::State {
  std::string file;
  std::string path;  // of this section, empty at the top
  YAML::Node node;   // a map, or null for an empty file
  std::vector<std::pair<std::string, YAML::Node>> entries;
  std::vector<YAML::Mark> key_marks;
  std::vector<std::string> known;
  std::vector<std::string> required;

  std::string path_of(const std::string& key) const { return path.empty() ? key : path + "." + key; }

  /// entries.size() when the key is not there.
  std::size_t index_of(const std::string& key) const {
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.first == key; });
    return static_cast<std::size_t>(found - entries.begin());
  }

  /// Notes that the key is known. Null when it is not there.
  const YAML::Node* find(const char* key) {
    known.emplace_back(key);
    const std::size_t i = index_of(key);
    return i < entries.size() ? &entries[i].second : nullptr;
  }

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& where, const std::string& why) const {
    throw BadInput(location(file, mark) + ": " + (where.empty() ? "" : where + ": ") + why);
  }

  /// Keys are compared here, since yaml-cpp accepts a key that is given twice.
  void read_entries() {
    if (node.IsNull()) return;

    if (!node.IsMap()) fail(node.Mark(), path, std::string("must be a section (key: value), but is ") + kind_of(node));

    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) fail(entry.first.Mark(), path, "a key must be a plain name");

      const std::string& key = entry.first.Scalar();
      if (index_of(key) < entries.size()) {
        fail(entry.first.Mark(), path_of(key),
             "given twice, first in line " + std::to_string(key_marks[index_of(key)].line + 1));
      }

      entries.emplace_back(key, entry.second);
      key_marks.push_back(entry.first.Mark());
    }
  }

  double number(const YAML::Node& item, const std::string& where, double low, double high) const {
    double value = 0.0;
    if (!parse(item, value)) fail(item.Mark(), where, "must be a number, but is " + shown(item));
    return within(item, where, value, low, high);
  }

  template <class Number>
  Number within(const YAML::Node& item, const std::string& where, Number value, Number low, Number high) const {
    if (!(value >= low && value <= high)) {
      fail(item.Mark(), where, item.Scalar() + " is out of bounds; give " + text_of(low) + " to " + text_of(high));
    }

    return value;
  }

  /// The whole text must be one decimal number; std::from_chars knows no locale and no blanks.
  template <class Number>
  static bool parse(const YAML::Node& item, Number& value) {
    if (!item.IsScalar() || is_quoted(item)) return false;

    const std::string& text = item.Scalar();
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return false;
    if constexpr (std::is_floating_point_v<Number>) return std::isfinite(value);

    return true;
  }

  /// Tells a number that is too large from one that is no whole number.
  template <class Number>
  void read_integer(const char* key, Number& value, Number low, Number high) {
    const YAML::Node* item = find(key);
    if (!item) return;

    Number read{};
    if (!parse(*item, read)) {
      double real = 0.0;
      const bool too_large = parse(*item, real) && std::floor(real) == real;

      if (too_large)
        fail(item->Mark(), path_of(key),
             item->Scalar() + " is out of bounds; give " + text_of(low) + " to " + text_of(high));

      fail(item->Mark(), path_of(key), "must be a whole number, but is " + shown(*item));
    }

    value = within(*item, path_of(key), read, low, high);
  }

  void must_be_list(const YAML::Node& item, const std::string& where) const {
    if (!item.IsSequence()) fail(item.Mark(), where, "must be a list, but is " + shown(item));
  }

  /// A list of numbers; errors name the place in it.
  std::vector<double> numbers(const YAML::Node& item, const std::string& where, double low, double high) const {
    must_be_list(item, where);

    std::vector<double> values;
    for (std::size_t i = 0; i < item.size(); ++i)
      values.push_back(number(item[i], where + "[" + std::to_string(i) + "]", low, high));

    return values;
  }
};

YamlReader::YamlReader(std::unique_ptr<State> state) : state_(std::move(state)) { state_->read_entries(); }
YamlReader::YamlReader(YamlReader&&) noexcept = default;
YamlReader& YamlReader::operator=(YamlReader&&) noexcept = default;
YamlReader::~YamlReader() = default;

YamlReader& YamlReader::field(const char* key, double& value, double low, double high) {
  if (const YAML::Node* item = state_->find(key)) value = state_->number(*item, state_->path_of(key), low, high);
  return *this;
}

YamlReader& YamlReader::field(const char* key, int& value, int low, int high) {
  state_->read_integer(key, value, low, high);
  return *this;
}

YamlReader& YamlReader::field(const char* key, std::uint64_t& value, std::uint64_t low, std::uint64_t high) {
  state_->read_integer(key, value, low, high);
  return *this;
}

YamlReader& YamlReader::field(const char* key, bool& value) {
  const YAML::Node* item = state_->find(key);
  if (!item) return *this;

  const bool is_boolean =
      item->IsScalar() && !is_quoted(*item) && (item->Scalar() == "true" || item->Scalar() == "false");
  if (!is_boolean) state_->fail(item->Mark(), state_->path_of(key), "must be true or false, but is " + shown(*item));
  value = item->Scalar() == "true";

  return *this;
}

YamlReader& YamlReader::field(const char* key, std::string& value) {
  const YAML::Node* item = state_->find(key);
  if (!item) return *this;

  if (!item->IsScalar()) state_->fail(item->Mark(), state_->path_of(key), "must be text, but is " + shown(*item));
  value = item->Scalar();

  return *this;
}

YamlReader& YamlReader::field(const char* key, std::vector<std::string>& values) {
  const YAML::Node* item = state_->find(key);
  if (!item) return *this;

  state_->must_be_list(*item, state_->path_of(key));

  std::vector<std::string> read;
  for (std::size_t i = 0; i < item->size(); ++i) {
    const YAML::Node element = (*item)[i];
    const std::string where = state_->path_of(key) + "[" + std::to_string(i) + "]";
    if (!element.IsScalar()) state_->fail(element.Mark(), where, "must be text, but is " + shown(element));
    read.push_back(element.Scalar());
  }

  values = std::move(read);
  return *this;
}

YamlReader& YamlReader::field(const char* key, std::vector<double>& values, double low, double high) {
  if (const YAML::Node* item = state_->find(key)) values = state_->numbers(*item, state_->path_of(key), low, high);
  return *this;
}

YamlReader& YamlReader::field(const char* key, std::vector<std::vector<double>>& rows, double low, double high) {
  const YAML::Node* item = state_->find(key);
  if (!item) return *this;

  state_->must_be_list(*item, state_->path_of(key));

  std::vector<std::vector<double>> read;
  for (std::size_t i = 0; i < item->size(); ++i) {
    read.push_back(state_->numbers((*item)[i], state_->path_of(key) + "[" + std::to_string(i) + "]", low, high));
  }

  rows = std::move(read);
  return *this;
}

YamlReader& YamlReader::require(const std::vector<std::string>& keys) {
  state_->required.insert(state_->required.end(), keys.begin(), keys.end());
  return *this;
}

bool YamlReader::has(const char* key) const { return state_->index_of(key) < state_->entries.size(); }

std::string YamlReader::where(const char* key) const {
  const std::size_t i = state_->index_of(key);
  const YAML::Mark mark = i < state_->entries.size() ? state_->key_marks[i] : state_->node.Mark();
  return location(state_->file, mark) + ": " + state_->path_of(key);
}

void YamlReader::reject(const char* key, const std::string& why) const { throw BadInput(where(key) + ": " + why); }

/// Unknown keys first: a mistyped key is often the missing one as well.
void YamlReader::finish() const {
  const State& s = *state_;
  for (std::size_t i = 0; i < s.entries.size(); ++i) {
    const std::string& key = s.entries[i].first;
    if (std::find(s.known.begin(), s.known.end(), key) != s.known.end()) continue;

    const std::string nearest = nearest_name(key, s.known);
    s.fail(s.key_marks[i], s.path,
           "unknown key '" + key + "'" + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
  }

  for (const std::string& key : s.required) {
    if (s.index_of(key) == s.entries.size()) s.fail(s.node.Mark(), s.path, "the key '" + key + "' is missing");
  }
}

/// The child knows its path, for errors.
std::optional<YamlReader> YamlReader::open(const char* key) {
  const YAML::Node* item = state_->find(key);
  if (!item) return std::nullopt;

  auto child = std::make_unique<State>();
  child->file = state_->file;
  child->path = state_->path_of(key);
  child->node = *item;

  return YamlReader(std::move(child));
}

std::optional<std::vector<YamlReader>> YamlReader::open_list(const char* key) {
  const YAML::Node* item = state_->find(key);
  if (!item) return std::nullopt;

  state_->must_be_list(*item, state_->path_of(key));

  std::vector<YamlReader> children;
  for (std::size_t i = 0; i < item->size(); ++i) {
    auto child = std::make_unique<State>();
    child->file = state_->file;
    child->path = state_->path_of(key) + "[" + std::to_string(i) + "]";
    child->node = (*item)[i];
    children.push_back(YamlReader(std::move(child)));
  }

  return children;
}

/// What yaml-cpp throws becomes BadInput with the line.
YamlReader open_yaml_text(const std::string& text, const std::string& name) {
  try {
    refuse_yaml_bombs(text, name);

    auto state = std::make_unique<YamlReader::State>();
    state->file = name;
    state->node = YAML::Load(text);

    return YamlReader(std::move(state));
  } catch (const YAML::Exception& error) {
    throw BadInput(location(name, error.mark) + ": not valid YAML: " + error.msg);
  }
}

/// Reads at most one byte more than is allowed, so that a huge file is refused without being read.
YamlReader open_yaml_file(const std::filesystem::path& file) {
  constexpr std::size_t kLargestBytes = 4u << 20;
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw BadInput(file.string() + ": is a directory; give a YAML file");

  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw BadInput(file.string() + ": cannot be read; check the path and its permissions");

  std::string text(kLargestBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));

  if (text.size() > kLargestBytes) throw BadInput(file.string() + ": larger than 4 MiB, the limit for a YAML file");

  return open_yaml_text(text, file.string());
}

}  // namespace aisle::config
