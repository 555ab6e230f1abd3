// What of a cycle's outcome is said on navigation_status.
#include "services/local-planner/codec.hpp"

#include <gtest/gtest.h>

#include <string>

#include "services/local-planner/core/recovery.hpp"

namespace aisle::local_planner {
namespace {

TEST(LocalPlannerCodec, EachGradeOfRecoveryIsToldInTheStatus) {
  for (const Grade grade : {Grade::kSlower, Grade::kFiner, Grade::kTurn, Grade::kBackOff}) {
    Output output;
    output.phase = Phase::kAvoiding;
    output.detail = told(grade);
    EXPECT_NE(output.detail, "");
    const aisle::NavigationStatus sample = encode_status(output);
    EXPECT_EQ(sample.detail().to_string(), told(grade));
    EXPECT_EQ(sample.phase(), NavigationPhase::PHASE_AVOIDING);
  }
}

TEST(LocalPlannerCodec, ALongDetailIsCutAndNotRefused) {
  Output output;
  output.detail = std::string(1000, 'x');
  const std::string told = encode_status(output).detail().to_string();
  EXPECT_GE(told.size(), 200U);
  EXPECT_EQ(told, std::string(told.size(), 'x'));
}

}  // namespace
}  // namespace aisle::local_planner
