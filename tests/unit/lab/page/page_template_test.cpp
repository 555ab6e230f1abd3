#include "tools/lab/page/page_template.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace aisle::lab {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Texts kTexts{{"table", "| name | figure |\n| --- | ---: |\n| a | 3 |\n\n"}, {"seeds", "30"}, {"nothing", ""}};

TEST(PageTemplate, JoinsTheLinesOfAParagraphAndFillsTextsIn) {
  EXPECT_EQ(fill("# Heading\n\n{seeds} seeds\nof each.\n\n{table}\n", kTexts).text,
            "# Heading\n\n30 seeds of each.\n\n| name | figure |\n| --- | ---: |\n| a | 3 |\n\n");
}

TEST(PageTemplate, KeepsWhatTheTablesBearOut) {
  const FilledPage page = fill("It is so:\n:claim table[a | figure] >= 3\nmuch.\n:end\n", kTexts);
  EXPECT_EQ(page.text, "It is so: much.\n\n");
  EXPECT_THAT(page.refuted, IsEmpty());
}

TEST(PageTemplate, LeavesOutWhatTheyDoNotAndSaysSo) {
  const FilledPage page = fill(":claim table[a | figure] > 3\nMuch\nmore than {seeds}.\n:end\n\nEnd.\n", kTexts);
  EXPECT_EQ(page.text, "End.\n\n");
  EXPECT_THAT(page.refuted, ElementsAre("\"Much more than 30.\" (table[a | figure] > 3: 3 against 3)"));
}

TEST(PageTemplate, HasPartsOnlyWhenThereIsSomethingInThem) {
  const std::string both =
      ":when nothing\nA.\n:claim table[a | no such column] > 1\nB.\n:end\n:end\n"
      ":unless nothing\nC.\n:end\n";
  const FilledPage page = fill(both, kTexts);
  EXPECT_EQ(page.text, "C.\n\n");
  EXPECT_THAT(page.refuted, IsEmpty()) << "nothing is claimed in a part that is not there";
}

TEST(PageTemplate, IsRefusedWhenItIsFaulty) {
  for (const char* faulty :
       {"{unknown}\n", "{seeds\n", ":when unknown\n:end\n", ":when seeds\nA.\n", ":end\n", ":if x\n"})
    EXPECT_THROW(fill(faulty, kTexts), std::invalid_argument) << faulty;
}

}  // namespace
}  // namespace aisle::lab
