#include "tests/unit/bus/topics_page.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/places.hpp"

namespace aisle::bus_test {
namespace {

TEST(TopicsPage, IsWhatTheTableOfTopicsSays) {
  std::ifstream file(test_support::source_folder().string() + "/docs/topics.md");
  const std::string committed{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(committed, topics_page()) << "docs/topics.md is old; run build/tests/aisle_topics_page > docs/topics.md";
}

}  // namespace
}  // namespace aisle::bus_test
