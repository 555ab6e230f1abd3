#include "tools/lab/page/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace aisle::lab {
namespace {

using Strings = std::vector<std::string>;

/// Without blanks at both ends.
std::string trimmed(const std::string& text) {
  const std::size_t from = text.find_first_not_of(' ');
  return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(' ') - from + 1);
}

/// The trimmed parts between the separators.
Strings split(const std::string& text, const std::string& by) {
  Strings parts;
  std::size_t from = 0;

  for (std::size_t to = text.find(by); to != std::string::npos; from = to + by.size(), to = text.find(by, from))
    parts.push_back(trimmed(text.substr(from, to - from)));

  parts.push_back(trimmed(text.substr(from)));
  return parts;
}

using Table = std::vector<Strings>;  // row by row, the heading first

/// All tables in a text of markdown.
std::vector<Table> tables_in(const std::string& markdown) {
  std::vector<Table> tables;
  std::istringstream lines(markdown);
  bool is_inside = false;

  for (std::string line; std::getline(lines, line);) {
    const bool is_row = line.size() > 1 && line.front() == '|' && line.back() == '|';
    if (is_row && !is_inside) tables.emplace_back();
    is_inside = is_row;
    if (is_row && line.rfind("| ---", 0) != 0) tables.back().push_back(split(line.substr(1, line.size() - 2), "|"));
  }

  return tables;
}

/// Do the row's first cells fit the keys?
bool is_meant(const Strings& row, const Strings& keys) {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Strings names = split(keys[i], "/");
    if (i >= row.size() || (keys[i] != "*" && std::find(names.begin(), names.end(), row[i]) == names.end()))
      return false;
  }

  return true;
}

/// One side of a condition: the texts of its cells. @throws std::invalid_argument when there is no such
/// table or column
Strings cells_of(const std::string& side, const Texts& texts) {
  static const std::regex form(R"(^(before |after )?(\w+)\[(.+)\]$)");
  std::smatch match;
  if (!std::regex_match(side, match, form)) return {side};  // a number or a word

  const auto text = texts.find(match[2]);
  if (text == texts.end()) throw std::invalid_argument("no table '" + match[2].str() + "' for " + side);

  Strings keys = split(match[3], "|");
  const std::string column = keys.back();

  keys.pop_back();

  Strings cells;
  bool has_column = false;

  for (const Table& table : tables_in(text->second)) {
    const auto at = std::find(table.front().begin(), table.front().end(), column);
    if (at == table.front().end()) continue;
    if (std::find(at + 1, table.front().end(), column) != table.front().end())
      throw std::invalid_argument("two columns '" + column + "': " + side);

    has_column = true;

    const auto index = static_cast<std::size_t>(at - table.front().begin());
    for (std::size_t row = 1; row < table.size(); ++row)
      if (is_meant(table[row], keys) && index < table[row].size()) cells.push_back(table[row][index]);
  }

  if (!has_column) throw std::invalid_argument("no such column: " + side);

  for (std::string& cell : cells) {
    const std::size_t arrow = cell.find("->");
    if (!match[1].matched || arrow == std::string::npos) continue;
    cell = match[1] == "before " ? cell.substr(0, arrow) : cell.substr(arrow + 2);
  }

  return cells;
}

/// The first number in it; none in "-".
std::optional<double> number_in(const std::string& cell) {
  static const std::regex number(R"(-?\d+(\.\d+)?)");
  std::smatch match;
  if (!std::regex_search(cell, match, number)) return std::nullopt;
  return std::strtod(match[0].str().c_str(), nullptr);
}

/// Cells without a number fulfil no comparison.
bool holds(const std::string& left, const std::string& op, const std::string& right) {
  if (op == "is") return trimmed(left) == right;

  const std::optional<double> a = number_in(left), b = number_in(right);
  if (!a || !b) return false;
  if (op == "<") return *a < *b;
  if (op == "<=") return *a <= *b;
  if (op == ">") return *a > *b;
  if (op == ">=") return *a >= *b;

  return *a == *b;
}

}  // namespace

/// Condition by condition, row by row; the first that does not hold is told.
std::optional<std::string> refutation(const std::string& conditions, const Texts& texts) {
  static const std::regex form(R"(^(.+) (<|<=|>|>=|==|is) (.+)$)");
  for (const std::string& condition : split(conditions, " and ")) {
    std::smatch match;
    if (!std::regex_match(condition, match, form)) throw std::invalid_argument("not a condition: '" + condition + "'");

    const Strings left_cells = cells_of(trimmed(match[1]), texts), right = cells_of(trimmed(match[3]), texts);
    if (right.size() > 1) throw std::invalid_argument("more than one value on the right: '" + condition + "'");
    if (left_cells.empty() || right.empty()) return condition + ": there is no such row";

    for (const std::string& left : left_cells) {
      if (!holds(left, match[2], right.front()))
        return fmt::format("{}: {} against {}", condition, trimmed(left), trimmed(right.front()));
    }
  }

  return std::nullopt;
}

}  // namespace aisle::lab
