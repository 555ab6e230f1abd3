#include "tools/lab/page/markdown.hpp"

#include <gtest/gtest.h>

namespace aisle::lab {
namespace {

const std::string kPage = "# Experiments\n\n<!-- b: begin -->\nB\n<!-- b: end -->\n";

TEST(WithSection, ReplacesTheSectionOfThatName) {
  EXPECT_EQ(with_section(kPage, "b", "new\n"), "# Experiments\n\n<!-- b: begin -->\nnew\n<!-- b: end -->\n");
}

TEST(WithSection, PutsANewOneBeforeThoseThatFollowIt) {
  EXPECT_EQ(with_section(kPage, "a", "A\n", {"none", "b"}),
            "# Experiments\n\n<!-- a: begin -->\nA\n<!-- a: end -->\n\n<!-- b: begin -->\nB\n<!-- b: end -->\n");
  EXPECT_EQ(with_section(kPage, "c", "C\n", {"d"}), kPage + "\n<!-- c: begin -->\nC\n<!-- c: end -->\n");
  EXPECT_EQ(with_section("", "a", "A\n"), "# Experiments\n\n<!-- a: begin -->\nA\n<!-- a: end -->\n");
}

}  // namespace
}  // namespace aisle::lab
