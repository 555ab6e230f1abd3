// docs/new-topic.md shows a topic as it stands in the tree: each block of code is in the file that the line above
// names.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/places.hpp"

namespace aisle {
namespace {

std::string read(const std::string& file) {
  std::ifstream in(test_support::source_folder() / file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(NewTopicPage, ShowsEachPlaceAsItStandsInTheTree) {
  const std::string page = read("docs/new-topic.md");
  int places = 0;
  std::size_t at = 0;
  while ((at = page.find("**" + std::to_string(places + 1) + ". `", at)) != std::string::npos) {
    ++places;
    const std::size_t name = page.find('`', at) + 1;
    const std::string file = page.substr(name, page.find('`', name) - name);
    const std::size_t begin = page.find('\n', page.find("\n```", name) + 1) + 1;
    const std::string code = page.substr(begin, page.find("\n```", begin) - begin);
    at = begin;

    // Functions of one block need not stand side by side in the file.
    std::size_t part = 0;
    while (part < code.size()) {
      const std::size_t end = std::min(code.find("\n\n", part), code.size());
      EXPECT_NE(read(file).find(code.substr(part, end - part)), std::string::npos) << file << " has no\n" << code;
      part = end + 2;
    }
  }
  EXPECT_EQ(places, 4) << "places that a topic touches";
}

}  // namespace
}  // namespace aisle
