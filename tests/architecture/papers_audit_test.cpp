// docs/papers-audit.md names every element of the five papers with its state, and a file and a test that exist.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/places.hpp"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

/// A row: paper, then the cells of docs/papers-audit.md.
struct Element {
  std::string paper, number, element, then, now, file, test_file, test, note;
};

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

Strings cells_of(const std::string& line) {
  Strings cells;
  std::istringstream in(line.substr(1, line.rfind('|') - 1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const std::size_t from = cell.find_first_not_of(" `");
    cells.push_back(from == std::string::npos ? "" : cell.substr(from, cell.find_last_not_of(" `") - from + 1));
  }
  return cells;
}

const fs::path kPage = test_support::source_folder() / "docs/papers-audit.md";

std::vector<Element> elements() {
  std::vector<Element> all;
  std::istringstream lines(text_of(kPage));
  std::string paper;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("## ", 0) == 0) paper = line.substr(3, line.find(':') - 3);
    static const std::regex kRow(R"(^\| \d+ \|.*)");
    if (paper.empty() || !std::regex_match(line, kRow)) continue;
    const Strings cells = cells_of(line);
    if (cells.size() != 9) {
      ADD_FAILURE() << "not nine cells: " << line;
      continue;
    }
    all.push_back({paper, cells[0], cells[1], cells[3], cells[4], cells[5], cells[6], cells[7], cells[8]});
  }
  return all;
}

/// A file, or some that a pattern with one star names.
bool exists(const std::string& name) {
  const fs::path full = test_support::source_folder() / name;
  const std::size_t star = name.find('*');
  if (star == std::string::npos) return fs::exists(full);
  const std::string begin = full.filename().string().substr(0, full.filename().string().find('*'));
  for (const auto& entry : fs::directory_iterator(full.parent_path()))
    if (entry.path().filename().string().rfind(begin, 0) == 0) return true;
  return false;
}

std::size_t count(const std::vector<Element>& all, const std::string& paper, const std::string& state) {
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const Element& element) {
    return (paper == "all" || element.paper == paper) && (state.empty() || element.now == state);
  }));
}

TEST(PapersAudit, HasEveryElementOfTheAudit) {
  const std::vector<Element> all = elements();
  const std::map<std::string, std::size_t> audited{{"LI", 33}, {"WU", 34}, {"QU", 35}, {"YU", 40}, {"WANG", 33}};
  for (const auto& [paper, elements] : audited) EXPECT_EQ(count(all, paper, ""), elements) << paper;
  EXPECT_EQ(all.size(), 175U);
  for (const Element& element : all)
    EXPECT_TRUE(std::regex_match(element.now, std::regex("[FRUMW]"))) << element.paper << " " << element.number;
}

TEST(PapersAudit, CountsItsRowsRightly) {
  const std::vector<Element> all = elements();
  const std::string page = text_of(kPage);
  for (const char* paper : {"LI", "WU", "QU", "YU", "WANG", "all"}) {
    std::string line = std::string("| ") + paper + " | " + std::to_string(count(all, paper, ""));
    for (const char* state : {"F", "R", "U", "M", "W"}) line += " | " + std::to_string(count(all, paper, state));
    EXPECT_NE(page.find(line + " |"), std::string::npos) << line;
  }
}

TEST(PapersAudit, GivesAReasonForWhatIsMissingOrRepaired) {
  for (const Element& element : elements()) {
    if (element.now == "M" || element.now != element.then) {
      EXPECT_FALSE(element.note.empty()) << element.paper << " " << element.number << ", " << element.element;
    }
  }
}

TEST(PapersAudit, NamesFilesAndTestsThatExist) {
  for (const Element& element : elements()) {
    const std::string row = element.paper + " " + element.number;
    EXPECT_TRUE(exists(element.file)) << row << ": " << element.file;
    EXPECT_TRUE(exists(element.test_file)) << row << ": " << element.test_file;
    const std::string tests = text_of(test_support::source_folder() / element.test_file);
    EXPECT_TRUE(std::regex_search(tests, std::regex("TEST(_F|_P)?\\(\\w+,\\s*" + element.test + "\\)")))
        << row << ": " << element.test;
  }
}

}  // namespace
}  // namespace aisle
