// docs/experiments.md is what its templates say of its own tables: no figure was left behind by a sentence.
#include "tests/unit/lab/page/committed_page.hpp"

#include <gmock/gmock.h>

#include <utility>

#include "tools/lab/page/templates.hpp"

namespace aisle::lab {
namespace {

using ::testing::IsEmpty;
using ::testing::MatchesRegex;

class CommittedPage : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(CommittedPage, SaysOfItsTablesOnlyWhatTheyBearOut) {
  const auto [name, page_template] = GetParam();
  const std::string section = committed_section(name);

  const FilledPage filled = fill(page_template, texts_of(page_template, section));
  EXPECT_THAT(filled.refuted, IsEmpty());
  EXPECT_EQ(filled.text, section);
}

// A commit that nobody else has makes nothing again.
TEST_P(CommittedPage, NamesTheCommitThatMadeEachSection) {
  const auto [name, page_template] = GetParam();
  EXPECT_THAT(texts_of(page_template, committed_section(name)).at("commit"), MatchesRegex("[0-9a-f]{7,12}"));
}

INSTANTIATE_TEST_SUITE_P(Sections, CommittedPage,
                         ::testing::Values(std::pair{"papers", kPapersTemplate},
                                           std::pair{"global planning", kGlobalPlanningTemplate},
                                           std::pair{"local planning", kLocalPlanningTemplate},
                                           std::pair{"obstacle tracking", kObstacleTrackingTemplate}));

}  // namespace
}  // namespace aisle::lab
