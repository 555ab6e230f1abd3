#include "tools/lab/results/result_text.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::lab {
namespace {

/// A string without its quotes; everything else as JSON writes it.
std::string plain(const Row& value) {
  if (value.is_null()) return "";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// In quotes where the text would break the row.
std::string cell(const Row& value) {
  const std::string text = plain(value);
  if (text.find_first_of(",\"\n\r#") == std::string::npos) return text;

  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

Row head_of(const std::string& made_by, const Provenance& provenance, const Row& particular) {
  Row head{{"made_by", made_by},
           {"commit", provenance.commit},
           {"compiler", provenance.compiler},
           {"build_type", provenance.build_type},
           {"flags", provenance.flags},
           {"vectors", provenance.vectors}};
  head.update(particular);
  return head;
}

std::string csv_head(const Row& head, const std::vector<std::string>& columns) {
  std::string text;
  for (const auto& [key, value] : head.items()) text += "# " + key + ": " + plain(value) + "\n";
  for (std::size_t i = 0; i < columns.size(); ++i) text += (i == 0 ? "" : ",") + cell(columns[i]);
  return text + "\n";
}

std::string csv_line(const Row& row, const std::vector<std::string>& columns) {
  std::string text;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto found = row.find(columns[i]);
    text += (i == 0 ? "" : ",") + (found == row.end() ? "" : cell(*found));
  }
  return text + "\n";
}

std::string jsonl_head(const Row& head) { return Row{{"head", head}}.dump() + "\n"; }

std::string jsonl_line(const Row& row) { return row.dump() + "\n"; }

std::vector<std::string> columns_of(const std::vector<Row>& rows) {
  std::vector<std::string> columns;
  for (const Row& row : rows) {
    for (const auto& [key, value] : row.items())
      if (std::find(columns.begin(), columns.end(), key) == columns.end()) columns.push_back(key);
  }
  return columns;
}

std::string csv_text(const Row& head, const std::vector<Row>& rows) {
  const std::vector<std::string> columns = columns_of(rows);
  std::string text = csv_head(head, columns);
  for (const Row& row : rows) text += csv_line(row, columns);
  return text;
}

std::string jsonl_text(const Row& head, const std::vector<Row>& rows) {
  std::string text = jsonl_head(head);
  for (const Row& row : rows) text += jsonl_line(row);
  return text;
}

Row finite(double value) { return std::isfinite(value) ? Row(value) : Row(nullptr); }

}  // namespace aisle::lab
