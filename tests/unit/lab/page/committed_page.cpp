#include "tests/unit/lab/page/committed_page.hpp"

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "tests/support/places.hpp"

namespace aisle::lab {
namespace {

using Strings = std::vector<std::string>;

std::string content_of(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

Strings paragraphs_of(const std::string& text) {
  Strings paragraphs;
  std::string paragraph;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) {
      paragraph += (paragraph.empty() ? "" : "\n") + line;
    } else if (!paragraph.empty()) {
      paragraphs.push_back(paragraph);
      paragraph.clear();
    }
  }
  if (!paragraph.empty()) paragraphs.push_back(paragraph);
  return paragraphs;
}

/// A paragraph of a template, without its directives: one placeholder, or words that may have placeholders inside.
struct Piece {
  std::string placeholder;  // empty: words
  std::regex begin;         // of the words
  Strings inside;           // names of the placeholders in `begin`, in order
};

std::vector<Piece> pieces_of(const std::string& page_template) {
  std::vector<Piece> pieces;
  for (const std::string& paragraph : paragraphs_of(page_template)) {
    std::string first;
    std::istringstream lines(paragraph);
    while (std::getline(lines, first) && first[0] == ':') continue;
    if (first.empty() || first[0] == ':') continue;
    static const std::regex alone(R"(^\{(\w+)\}$)"), inner(R"(\{(\w+)\})");
    std::smatch match;
    if (std::regex_match(first, match, alone)) {
      pieces.push_back({match[1], {}, {}});
      continue;
    }
    Piece piece;
    for (std::sregex_iterator it(first.begin(), first.end(), inner), end; it != end; ++it)
      piece.inside.push_back((*it)[1]);
    std::string form = std::regex_replace(first, std::regex(R"([.*+?()\[\]\\^$|])"), R"(\$&)");
    piece.begin = std::regex("^" + std::regex_replace(form, inner, "(\\S+)"));
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace

std::string committed_section(const std::string& name) {
  const std::string page = content_of((test_support::source_folder() / "docs/experiments.md").string());
  const std::string begin = "<!-- " + name + ": begin -->\n";
  const std::size_t from = page.find(begin), to = page.find("<!-- " + name + ": end -->");
  if (from == std::string::npos || to == std::string::npos) throw std::runtime_error("no section " + name);
  return page.substr(from + begin.size(), to - from - begin.size());
}

Texts texts_of(const std::string& page_template, const std::string& section) {
  const std::vector<Piece> pieces = pieces_of(page_template);
  const Strings paragraphs = paragraphs_of(section);
  Texts texts;
  std::size_t at = 0;
  const auto find = [&](const Piece& piece) {
    for (std::size_t i = at; i < paragraphs.size(); ++i)
      if (std::regex_search(paragraphs[i], piece.begin)) return i;
    return paragraphs.size();
  };
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (pieces[p].placeholder.empty()) {
      const std::size_t found = find(pieces[p]);
      if (found == paragraphs.size()) continue;  // a part that is not there
      std::smatch match;
      std::regex_search(paragraphs[found], match, pieces[p].begin);
      for (std::size_t i = 0; i < pieces[p].inside.size(); ++i) texts[pieces[p].inside[i]] = match[i + 1];
      at = found + 1;
      continue;
    }
    const bool is_last = p + 1 == pieces.size();
    const std::size_t end = is_last                             ? paragraphs.size()
                            : pieces[p + 1].placeholder.empty() ? find(pieces[p + 1])
                                                                : at + 1;
    for (; at < end; ++at) texts[pieces[p].placeholder] += paragraphs[at] + "\n\n";
  }
  return texts;
}

}  // namespace aisle::lab
