#include "tools/lab/page/claims.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace aisle::lab {
namespace {

using ::testing::HasSubstr;

const Texts kTexts{
    {"planners",
     "| planner | from | shorter | time s |\n| --- | ---: | ---: | ---: |\n"
     "| li | drawn | 100 % | 8.30 -> 7.27 |\n| li | drivable | 0 % | - |\n| wu | drawn | 85 % | 1.5 -> 2 |\n"
     "\nWords between tables.\n\n| planner | goal |\n| --- | ---: |\n| li | not reached |\n"}};

TEST(Claims, AreBorneOutByEveryRowThatIsMeant) {
  EXPECT_EQ(refutation("planners[li | drawn | shorter] >= 95", kTexts), std::nullopt);
  EXPECT_EQ(refutation("planners[* | drawn | shorter] >= 85", kTexts), std::nullopt);
  EXPECT_EQ(refutation("planners[li/wu | drawn | shorter] > 80 and planners[li | drivable | shorter] == 0", kTexts),
            std::nullopt);
  EXPECT_THAT(*refutation("planners[* | * | shorter] >= 85", kTexts), HasSubstr("0 % against 85"));
}

TEST(Claims, CompareBothSidesOfAnArrowAndOtherCells) {
  EXPECT_EQ(refutation("after planners[li | drawn | time s] < before planners[li | drawn | time s]", kTexts),
            std::nullopt);
  EXPECT_THAT(*refutation("after planners[wu | drawn | time s] < before planners[wu | drawn | time s]", kTexts),
              HasSubstr("2 against 1.5"));
}

TEST(Claims, MayBeAboutWords) {
  EXPECT_EQ(refutation("planners[li | goal] is not reached", kTexts), std::nullopt);
  EXPECT_NE(refutation("planners[li | goal] is reached", kTexts), std::nullopt);
}

TEST(Claims, AreNotBorneOutByWhatWasNotMeasured) {
  EXPECT_NE(refutation("planners[li | drivable | time s] >= 0", kTexts), std::nullopt) << "no number";
  EXPECT_THAT(*refutation("planners[yu | drawn | shorter] >= 0", kTexts), HasSubstr("no such row"));
}

TEST(Claims, ThatCannotBeReadAreFaultsOfTheTemplate) {
  EXPECT_THROW(refutation("planners[li | drawn | longer] > 1", kTexts), std::invalid_argument);
  EXPECT_THROW(refutation("twice[a | b] > 1", {{"twice", "| n | b | b |\n| --- | --- | --- |\n| a | 1 | 2 |\n"}}),
               std::invalid_argument);
  EXPECT_THROW(refutation("planner[li | drawn | shorter] > 1", kTexts), std::invalid_argument);
  EXPECT_THROW(refutation("planners[li | drawn | shorter]", kTexts), std::invalid_argument);
  EXPECT_THROW(refutation("1 < planners[* | drawn | shorter]", kTexts), std::invalid_argument);
}

}  // namespace
}  // namespace aisle::lab
