#include "tools/cli/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace aisle::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kShownElements = 8;  // of a long list
constexpr std::size_t kWidestLine = 110;   // characters; longer structures get a line for each member

/// A value that is neither list nor structure.
std::string scalar(const Json& value) {
  if (value.is_string()) {
    const std::string text = printable(value.get_ref<const std::string&>());
    return text.empty() ? "\"\"" : text;
  }

  if (value.is_number_float()) return fmt::format("{:.7g}", value.get<double>());
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_unsigned()) return std::to_string(value.get<std::uint64_t>());
  if (value.is_number_integer()) return std::to_string(value.get<std::int64_t>());

  return "null";
}

std::string on_one_line(const Json& value, Length length);

/// Cut after kShownElements unless kFull.
std::string list_on_one_line(const Json& list, Length length) {
  const std::size_t shown = length == Length::kFull ? list.size() : std::min(list.size(), kShownElements);
  std::string text = "[";

  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : ", ") + on_one_line(list[i], length);
  if (shown < list.size()) text += fmt::format(", ... {} in all", list.size());

  return text + "]";
}

/// Structures as {a: 1, b: 2}.
std::string on_one_line(const Json& value, Length length) {
  if (value.is_array()) return list_on_one_line(value, length);
  if (!value.is_object()) return scalar(value);

  std::string text = "{";
  for (const auto& [key, member] : value.items())
    text += (text.size() == 1 ? "" : ", ") + printable(key) + ": " + on_one_line(member, length);

  return text + "}";
}

/// Rows of letters, drawn one below the other.
bool is_picture(const std::string& key, const Json& value) {
  return key == "picture" && value.is_array() && !value.empty() && value.front().is_string();
}

/// One line a member; structures and lists of structures that are too long for a line go on below, indented.
void add_lines(const Json& object, Length length, const std::string& indent, std::string& out) {
  for (const auto& [key, value] : object.items()) {
    if (is_picture(key, value)) {
      out += indent + key + ":\n";
      for (const Json& row : value)
        out += indent + "  |" + (row.is_string() ? printable(row.get<std::string>()) : "") + "|\n";
      continue;
    }

    const std::string line = indent + printable(key) + ": " + on_one_line(value, length);
    const bool is_list_of_structures = value.is_array() && !value.empty() && value.front().is_object();

    if (line.size() <= kWidestLine || !(value.is_object() || is_list_of_structures)) {
      out += line + "\n";
      continue;
    }

    out += indent + printable(key) + ":\n";

    if (value.is_object()) {
      add_lines(value, length, indent + "  ", out);
      continue;
    }

    const std::size_t shown = length == Length::kFull ? value.size() : std::min(value.size(), kShownElements);
    for (std::size_t i = 0; i < shown; ++i) out += indent + "  - " + on_one_line(value[i], length) + "\n";
    if (shown < value.size()) out += indent + fmt::format("  ... {} in all\n", value.size());
  }
}

}  // namespace

std::string printable(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x20 || byte == 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }

  return out;
}

std::string word(const Json& row, const char* key) {
  const std::string text = row.value(key, "");
  return text.empty() || text == "none" ? "-" : text;
}

std::string word_of(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string text_of_sample(const Json& sample, Length length) {
  std::string out;
  add_lines(sample, length, "", out);
  return out;
}

/// Each column is as wide as its widest cell; blanks at line ends are left out.
std::string text_of_table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const std::vector<std::string>& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t column = 0; column < row.size(); ++column)
      widths[column] = std::max(widths[column], printable(row[column]).size());
  }

  std::string out;
  for (const std::vector<std::string>& row : rows) {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column)
      line += fmt::format("{:<{}}  ", printable(row[column]), widths[column]);

    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }

  return out;
}

}  // namespace aisle::cli
