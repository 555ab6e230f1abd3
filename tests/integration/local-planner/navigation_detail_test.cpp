// The detail of a navigation_status, from the core to the wire.
#include <gtest/gtest.h>

#include <string>

#include "common/wire/planning.hpp"
#include "services/local-planner/core/recovery.hpp"

namespace aisle::local_planner {
namespace {

TEST(NavigationDetail, EachGradeOfRecoveryIsToldInTheStatus) {
  for (const Grade grade : {Grade::kSlower, Grade::kFiner, Grade::kTurn, Grade::kBackOff}) {
    fleet::NavigationStatus status;
    status.phase = fleet::Phase::kAvoiding;
    status.detail = told(grade);
    EXPECT_NE(status.detail, "");
    const aisle::NavigationStatus sample = wire::encode(status);
    EXPECT_EQ(sample.detail().to_string(), told(grade));
    EXPECT_EQ(sample.phase(), NavigationPhase::PHASE_AVOIDING);
  }
}

TEST(NavigationDetail, ALongDetailIsCutAndNotRefused) {
  fleet::NavigationStatus status;
  status.detail = std::string(1000, 'x');
  const std::string told = wire::encode(status).detail().to_string();
  EXPECT_GE(told.size(), 200U);
  EXPECT_EQ(told, std::string(told.size(), 'x'));
}

}  // namespace
}  // namespace aisle::local_planner
