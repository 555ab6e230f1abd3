// Every number of a variant by name.
#include "services/local-planner/core/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace aisle::local_planner {
namespace {

TEST(Parameters, OfEachVariantHaveNamesOfTheirOwnAndLieWithinTheirRanges) {
  for (Variant variant : all_variants()) {
    std::set<std::string> names;
    for (const Parameter& it : parameters_of(variant)) {
      EXPECT_FALSE(it.name.empty()) << variant.name;
      EXPECT_TRUE(names.insert(it.name).second) << variant.name << "." << it.name << " is there twice";
      EXPECT_TRUE(*it.value >= it.least && *it.value <= it.most) << variant.name << "." << it.name << " " << *it.value;
    }
    for (const char* name : {"alpha", "beta", "gamma", "max_speed_mps", "horizon_s", "next_target_m", "radius_m"})
      EXPECT_EQ(names.count(name), 1u) << variant.name << "." << name;
  }
}

// Which weight a paper's letter means differs from paper to paper: LI beta is the distance, WU's is the speed.
TEST(Parameters, HaveThePapersSymbolsForTheWeights) {
  const auto weight_of = [](const char* variant_name, const char* symbol) {
    for (const WeightedCritic& it : find_variant(variant_name)->critics)
      if (it.symbol == symbol) return it.weight;
    return -1.0;
  };
  EXPECT_EQ(weight_of("li", "beta"), 0.2);
  EXPECT_EQ(weight_of("li", "gamma"), 0.3);
  EXPECT_EQ(weight_of("li", "eta"), 0.1);
  EXPECT_EQ(weight_of("wu", "beta"), 0.3);
  EXPECT_EQ(weight_of("wu", "gamma"), 0.15);
  EXPECT_EQ(weight_of("wu", "eta"), 0.2);
  EXPECT_EQ(weight_of("wu", "lambda"), 0.15);
  EXPECT_EQ(weight_of("qu", "eta"), 0.4);
  EXPECT_EQ(weight_of("yu", "gamma"), 0.5);
  EXPECT_EQ(weight_of("wang", "alpha"), 0.05);
}

TEST(Parameters, AreSetByName) {
  Variant variant = wang();
  EXPECT_EQ(set_parameter(variant, "alpha", 0.1), "");
  EXPECT_EQ(set_parameter(variant, "max_speed_mps", 1.0), "");
  EXPECT_EQ(set_parameter(variant, "next_target_m", 0.5), "");
  EXPECT_EQ(variant.critics.front().weight, 0.1);
  EXPECT_EQ(variant.paper.max_speed_mps, 1.0);
  EXPECT_EQ(variant.printed.next_target_m, 0.5);
  EXPECT_EQ(variant.critics[1].weight, wang().critics[1].weight);
}

TEST(Parameters, RefuseWhatIsUnknownOrOutOfRangeAndKeepTheirValue) {
  Variant variant = wang();
  EXPECT_THAT(set_parameter(variant, "alfa", 0.1),
              testing::AllOf(testing::HasSubstr("wang has no parameter 'alfa'"), testing::HasSubstr("alpha")));
  EXPECT_THAT(set_parameter(variant, "alpha", -0.1), testing::HasSubstr("wang.alpha is a number from 0 to 100"));
  EXPECT_THAT(set_parameter(variant, "radius_m", 0.0), testing::HasSubstr("from 0.05 to 5"));
  EXPECT_NE(set_parameter(variant, "alpha", std::nan("")), "");
  EXPECT_EQ(variant.critics.front().weight, 0.05);
}

}  // namespace
}  // namespace aisle::local_planner
