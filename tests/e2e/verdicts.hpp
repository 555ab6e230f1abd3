#pragma once
// What every run of a fleet must show, whatever the scenario.
#include <gtest/gtest.h>

#include "tests/e2e/demo_run.hpp"

namespace aisle::e2e {

/// All goals reached, nothing touched, nobody obeyed a stranger.
inline void expect_passed(const DemoRun& run) {
  ASSERT_TRUE(run.report.is_object()) << "no report.json\n" << run.output;
  EXPECT_EQ(run.code, 0) << run.output;
  EXPECT_EQ(run.report["goals_reached"], run.report["goals_expected"]) << run.output;
  EXPECT_GT(run.report["goals_expected"].get<int>(), 0);
  EXPECT_EQ(run.report["contacts_moving_vehicle"], 0) << run.output;
  EXPECT_EQ(run.report["authority_violations"], 0) << run.output;
  EXPECT_GT(run.report["distance_m"].get<double>(), 1.0);
}

/// An assertion of Debian's Fast DDS 2.9.1 that fails when a peer's lease is looked at in the moment in which it
/// leaves; seen on machines with far more work than cores. The restart policy is what helps, here as in production.
inline bool is_fault_of_the_middleware(const nlohmann::json& death) {
  return death["ending"] == "signal 6" &&
         death["last_words"].get<std::string>().find("check_remote_participant_liveliness") != std::string::npos;
}

/// Besides: everything that was started ran to the end and stopped when asked.
inline void expect_clean(const DemoRun& run) {
  ASSERT_TRUE(run.processes.is_object()) << run.output;
  for (const nlohmann::json& death : run.processes["deaths"]) {
    EXPECT_TRUE(is_fault_of_the_middleware(death)) << death.dump() << "\n" << run.output;
  }
}

}  // namespace aisle::e2e
