// The list of all that may be set: what it says can be done.
#include "tools/lab/parameters/named_parameters.hpp"

#include <gmock/gmock.h>

#include <set>
#include <string>

#include "common/config/reader.hpp"
#include "tools/lab/parameters/parameter_values.hpp"

namespace aisle::lab {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

TEST(NamedParameters, HaveADefaultARangeAMeaningAndANameOfTheirOwn) {
  std::set<std::string> names;
  for (const NamedParameter& it : named_parameters()) {
    EXPECT_TRUE(names.insert(it.full_name()).second) << it.full_name() << " is there twice";
    EXPECT_FALSE(it.default_value.empty()) << it.full_name();
    EXPECT_FALSE(it.range.empty()) << it.full_name();
    EXPECT_FALSE(it.unit.empty()) << it.full_name();
    EXPECT_FALSE(it.meaning.empty()) << it.full_name();
  }
}

TEST(NamedParameters, CanAllBeSetToTheirDefaults) {
  for (const NamedParameter& it : named_parameters())
    EXPECT_NO_THROW(parse_parameter("--set", it.full_name() + "=" + it.default_value)) << it.full_name();
}

TEST(NamedParameters, AreWeightsLimitsPassesAndRulesOfBothPlanners) {
  std::set<std::string> names;
  for (const NamedParameter& it : named_parameters()) names.insert(it.full_name());
  EXPECT_THAT(names, IsSupersetOf({"global.wang.log_base", "global.wang.heuristic", "global.wang.neighbours",
                                   "global.wang.passes", "global.yu.beta", "local.yu.beta", "local.wang.alpha",
                                   "local.wang.max_speed_mps", "local.li.target_rule", "local.wu.model",
                                   "global.global-planner.margin_m", "local.local-planner.horizon_s"}));
}

TEST(NamedParameters, KnowTheirUnitsAndTheDrivesInWhichTheyCount) {
  EXPECT_EQ(find_parameter("", "wang.max_turn_acceleration_radps2").unit, "rad/s^2");
  EXPECT_EQ(find_parameter("", "wang.max_speed_mps").unit, "m/s");
  EXPECT_EQ(find_parameter("", "wang.alpha").unit, "-");
  EXPECT_EQ(find_parameter("", "wang.alpha").condition, "");
  EXPECT_EQ(find_parameter("", "wang.target_rule").condition, "--as-printed");
}

TEST(NamedParameters, OfOnePlannerAreThoseOfItsBothSides) {
  std::set<Side> sides;
  for (const NamedParameter& it : parameters_of_planner("yu")) {
    EXPECT_EQ(it.planner, "yu");
    sides.insert(it.side);
  }
  EXPECT_EQ(sides.size(), 2U);
  EXPECT_EQ(parameters_of_planner("").size(), named_parameters().size());
  try {
    parameters_of_planner("wnag");
    FAIL();
  } catch (const config::BadInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'wang'?"));
  }
}

}  // namespace
}  // namespace aisle::lab
