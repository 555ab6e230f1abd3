// docs/papers-audit.md names every element of the five papers with its state, as its author and a second reader give
// it, and a file and a test that exist.
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

/// A row: paper, then the cells of docs/papers-audit.md. The second reader's cell is a state, and where it is another
/// one than the author's, a colon and the reason.
struct Element {
  std::string paper, number, element, then, now, file, test_file, test, note, second, reason;
  std::string row() const { return paper + " " + number + ", " + element; }
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
    if (cells.size() != 10) {
      ADD_FAILURE() << "not ten cells: " << line;
      continue;
    }
    Element element{paper, cells[0], cells[1], cells[3], cells[4], cells[5], cells[6], cells[7], cells[8], "", ""};
    element.second = cells[9].substr(0, 1);
    if (cells[9].size() > 3 && cells[9].substr(1, 2) == ": ") element.reason = cells[9].substr(3);
    all.push_back(element);
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

using Column = std::string Element::*;

std::size_t count(const std::vector<Element>& all, const std::string& paper, const std::string& state,
                  Column column = &Element::now) {
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const Element& element) {
    return (paper == "all" || element.paper == paper) && (state.empty() || element.*column == state);
  }));
}

/// A file's text as one line, without the marks of comments: a sentence is found however it is broken.
std::string sentences_of(const fs::path& file) {
  return std::regex_replace(text_of(file), std::regex(R"(\s*\n\s*(//[/!]?)?\s*)"), " ");
}

TEST(PapersAudit, HasEveryElementOfTheAudit) {
  const std::vector<Element> all = elements();
  const std::map<std::string, std::size_t> audited{{"LI", 33}, {"WU", 34}, {"QU", 35}, {"YU", 40}, {"WANG", 33}};
  for (const auto& [paper, elements] : audited) EXPECT_EQ(count(all, paper, ""), elements) << paper;
  EXPECT_EQ(all.size(), 175U);
  for (const Element& element : all) {
    EXPECT_TRUE(std::regex_match(element.now, std::regex("[FRUMW]"))) << element.row();
    EXPECT_TRUE(std::regex_match(element.second, std::regex("[FRUMW]"))) << element.row();
  }
}

TEST(PapersAudit, CountsItsRowsRightly) {
  const std::vector<Element> all = elements();
  const std::string page = text_of(kPage);
  for (const char* paper : {"LI", "WU", "QU", "YU", "WANG", "all"}) {
    std::string line = std::string("| ") + paper + " | " + std::to_string(count(all, paper, ""));
    for (const Column column : {&Element::now, &Element::second})
      for (const char* state : {"F", "R", "U", "M", "W"})
        line += " | " + std::to_string(count(all, paper, state, column));
    EXPECT_NE(page.find(line + " |"), std::string::npos) << line;
  }
}

TEST(PapersAudit, LeavesNothingWrongOrUndocumented) {
  for (const Element& element : elements())
    for (const Column column : {&Element::now, &Element::second})
      EXPECT_TRUE(element.*column != "W" && element.*column != "U") << element.row();
}

TEST(PapersAudit, GivesAReasonWhereTheTwoReadersDiffer) {
  for (const Element& element : elements())
    EXPECT_EQ(element.now != element.second, !element.reason.empty()) << element.row();
}

TEST(PapersAudit, GivesAReasonForWhatIsMissingOrRepaired) {
  for (const Element& element : elements()) {
    if (element.now == "M" || element.now != element.then) {
      EXPECT_FALSE(element.note.empty()) << element.row();
    }
  }
}

TEST(PapersAudit, NamesFilesAndTestsThatExist) {
  for (const Element& element : elements()) {
    EXPECT_TRUE(exists(element.file)) << element.row() << ": " << element.file;
    EXPECT_TRUE(exists(element.test_file)) << element.row() << ": " << element.test_file;
    const std::string tests = text_of(test_support::source_folder() / element.test_file);
    EXPECT_TRUE(std::regex_search(tests, std::regex("TEST(_F|_P)?\\(\\w+,\\s*" + element.test + "\\)")))
        << element.row() << ": " << element.test;
  }
}

// A repair counts as said only where a reader of the code meets it.
TEST(PapersAudit, RepairsAndOmissionsAreSaidInTheCode) {
  const std::string global = "services/global-planner/core/", local = "services/local-planner/core/";
  const std::string models = "common/kinematics/omnidirectional.hpp";
  struct Said {
    const char* rows;
    std::string file;
    const char* words;
  };
  for (const Said& said : std::vector<Said>{
           {"LI 2", global + "variants/li.cpp", "Left out: the numbering of cells (eq. 1)"},
           {"LI 6, YU 13", models, "LI and YU end it with - v_y dt cos(theta)"},
           {"LI 8", local + "variants/li.cpp", "Eq. 6 prints a minus on both sides of w"},
           {"LI 9, QU 13, YU 16, WANG 11", local + "obstruction.cpp", "Repaired: the papers' V_a"},
           {"LI 12, YU 18", local + "critics/clearance.cpp", "least clearance along the trajectory, capped"},
           {"LI 15", global + "variants/li.cpp", "Repaired: eq. 9 prints r/R"},
           {"LI 18", global + "variants/li.cpp", "\"9*9 improved A*\" (IV.C), which is explained nowhere"},
           {"LI 19", local + "printed/target_rules/nearest_path_point.cpp", "that is not reached yet"},
           {"LI 20", local + "critics/sub_target_heading.cpp", "a look-ahead further on"},
           {"LI 21", local + "variants/li.cpp", "Table III calls gamma \"dynamic distance\""},
           {"LI 24", global + "traditional_astar.hpp",
            "LI's figures (18.00 on a map of 10x10) are those of four moves"},
           {"LI 22", local + "variants/li.cpp", "prints eq. 10 as the only means"},
           {"LI 29", "tools/lab/driving/encounters.hpp", "all other places stand in the papers' pictures alone"},
           {"QU 33, QU 34, WANG 29", "tools/lab/driving/encounters.hpp", "What every contestant on this map meets"},
           {"LI 32", global + "variants/ant_colony.cpp", "LI's comparator (its table V)"},
           {"WU 7", local + "variants/wu.cpp", "Section 3.2: an Ackermann forklift"},
           {"WU 10", local + "critics/path_distance.cpp", "Repaired: WU says that the lowest cost wins"},
           {"WU 11", local + "critics/sub_target_distance.cpp", "Looked at where the trajectory is after the heading"},
           {"WU 14", local + "variants/wu.cpp", "minimum acceleration of 0 is read as -0.2 m/s^2"},
           {"WU 16", local + "rolling_window.hpp", "WU eqs. 6 and 7 ask that (v1 + v2) T < r"},
           {"WU 17", local + "rolling_window.hpp", "eq. 11's minus sign and its \"delta >= 0\" fail"},
           {"WU 20, WU 21", local + "rolling_window.hpp", "reachable: straight on, within 0.8 rad of the heading"},
           {"QU 1", "services/global-planner/README.md", "cut no corner"},
           {"QU 4", global + "variants/qu.cpp", "Eq. 3 prints the weight without the logarithm"},
           {"QU 5", global + "variants/qu.cpp", "it is clamped to [0, 1]"},
           {"QU 7", global + "fleet_types.hpp", "for the planners `qu` and `yu`: between the vehicle and obstacles"},
           {"QU 9", global + "variants/qu.cpp", "here it is opened again"},
           {"QU 17", local + "critics/static_clearance.cpp", "Repaired: eq. 12 prints 1/D"},
           {"QU 18", local + "critics/dynamic_clearance.cpp", "eq. 14 takes the distance of the centres"},
           {"YU 7", global + "variants/yu.cpp", "P counts the cells of both ends"},
           {"YU 9", global + "variants/yu.cpp", "Algorithm 1 prints g as the Manhattan distance from the start"},
           {"YU 15", local + "variants/yu.cpp", "Eq. 9 prints v + dv for the upper end of V_d"},
           {"YU 23", local + "variants/yu.cpp", "Its turn rates are degrees, printed as radians"},
           {"YU 24", local + "variants/yu.cpp", "0.4 m/s^2 is chosen"},
           {"WANG 2", global + "variants/wang.cpp", "Eq. 2 prints g as the Euclidean distance from the start"},
           {"WANG 7", global + "variants/wang.cpp", "it goes on from N_(k-1)"},
           {"WANG 8", models, "WANG has v_y dt sin(theta) + v_x dt cos(theta)"},
           {"LI 8, YU 15, WANG 10", local + "printed/as_printed.hpp", "WU, QU; chosen for the others"},
           {"WANG 16", local + "variants/wang.cpp", "Its turn rates are degrees, printed as radians"},
           {"WANG 20", global + "variants/modified_astar.cpp", "WANG prints no formula for it; this is our reading"}})
    EXPECT_NE(sentences_of(test_support::source_folder() / said.file).find(said.words), std::string::npos)
        << said.rows << ": " << said.file << " no longer says: " << said.words;
}

}  // namespace
}  // namespace aisle
