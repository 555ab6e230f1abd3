#include "tools/lab/page/markdown.hpp"

#include <fmt/format.h>

#include <cmath>

namespace aisle::lab {

std::string markdown_table(const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += "|";
    for (const std::string& cell : rows[i]) text += " " + cell + " |";
    text += "\n";

    if (i > 0) continue;

    text += "|";
    for (std::size_t column = 0; column < rows[0].size(); ++column) text += column == 0 ? " --- |" : " ---: |";
    text += "\n";
  }

  return text + "\n";
}

std::string digits(double value, int after_point) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, after_point) : "-";
}

/// Markers that are not both there count as none.
std::string with_section(const std::string& page, const std::string& name, const std::string& text,
                         const std::vector<std::string>& next) {
  const auto begin_of = [](const std::string& section) { return "<!-- " + section + ": begin -->\n"; };
  const std::string begin = begin_of(name), end = "<!-- " + name + ": end -->\n";
  const std::size_t from = page.find(begin);

  const std::size_t to = from == std::string::npos ? std::string::npos : page.find(end, from);
  if (to != std::string::npos) return page.substr(0, from) + begin + text + page.substr(to);

  for (const std::string& follower : next) {
    const std::size_t at = page.find(begin_of(follower));
    if (at != std::string::npos) return page.substr(0, at) + begin + text + end + "\n" + page.substr(at);
  }

  return page + (page.empty() ? "# Experiments\n\n" : "\n") + begin + text + end;
}

}  // namespace aisle::lab
