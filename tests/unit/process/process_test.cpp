#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "common/config/reader.hpp"
#include "common/process/clock.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/leaving.hpp"
#include "common/process/log.hpp"
#include "common/process/memory.hpp"
#include "common/process/own_usage.hpp"
#include "common/process/signals.hpp"

namespace aisle::process {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::MatchesRegex;

std::string stderr_of(const std::function<void()>& action) {
  ::testing::internal::CaptureStderr();
  action();
  spdlog::default_logger()->flush();
  return ::testing::internal::GetCapturedStderr();
}

TEST(ExitCode, OfEachKindOfFailureWithOneLine) {
  EXPECT_EQ(run_guarded("p", [] { return 1; }), kNegative);
  EXPECT_EQ(run_guarded("p", [] { return 0; }), kDone);
  int code = 0;
  EXPECT_EQ(stderr_of([&] { code = run_guarded("p", []() -> int { throw config::BadInput("x.yaml:3: no"); }); }),
            "p: x.yaml:3: no\n");
  EXPECT_EQ(code, kBadInput);
  EXPECT_EQ(stderr_of([&] { code = run_guarded("p", []() -> int { throw config::BadEnvironment("no interface"); }); }),
            "p: no interface\n");
  EXPECT_EQ(code, kEnvironment);
  EXPECT_EQ(stderr_of([&] { code = run_guarded("p", []() -> int { throw std::logic_error("bug"); }); }), "p: bug\n");
  EXPECT_EQ(code, kNegative);
}

TEST(Log, WritesOneLineOfKeysAndValues) {
  const std::string line = stderr_of([] {
    start_logging("map-1", "info");
    spdlog::debug("not shown");
    spdlog::info("revision {}", 3);
  });
  EXPECT_THAT(line,
              MatchesRegex("time=[0-9-]+T[0-9:]+\\.[0-9][0-9][0-9]Z level=info instance=map-1 text=\"revision 3\"\n"));
}

TEST(Log, TextCannotBreakTheLine) {
  const std::string line = stderr_of([] {
    start_logging("map%v", "warning");
    spdlog::warn("a\nlevel=error \"x\" \\ \x1b[0m");
  });
  EXPECT_THAT(
      line, MatchesRegex(
                ".* level=warning instance=map%v text=\"a\\\\x0alevel=error \\\\\"x\\\\\" \\\\\\\\ \\\\x1b\\[0m\"\n"));
}

TEST(Log, RefusesAnUnknownLevelWithTheNearest) {
  try {
    start_logging("map-1", "inf");
    FAIL();
  } catch (const config::BadInput& error) {
    EXPECT_STREQ(error.what(), "--log-level: 'inf' is none of debug, info, warning, error, off; did you mean 'info'?");
  }
}

TEST(RateLimit, LetsTheFirstOfEachKindThroughThenOneAPeriod) {
  RateLimit limit(seconds(10));
  EXPECT_TRUE(limit.ask("a", seconds(1)).allowed);
  EXPECT_TRUE(limit.ask("b", seconds(1)).allowed);
  EXPECT_FALSE(limit.ask("a", seconds(2)).allowed);
  EXPECT_FALSE(limit.ask("a", milliseconds(10999)).allowed);
  const RateLimit::Pass pass = limit.ask("a", seconds(11));
  EXPECT_TRUE(pass.allowed);
  EXPECT_EQ(pass.kept_back, 2u);
  EXPECT_EQ(limit.ask("a", seconds(21)).kept_back, 0u);
}

TEST(RateLimit, StaysBoundedUnderAFloodOfKinds) {
  RateLimit limit(seconds(10), 4);
  int allowed = 0;
  for (int i = 0; i < 1000; ++i) allowed += limit.ask("kind " + std::to_string(i), seconds(1)).allowed ? 1 : 0;
  EXPECT_EQ(allowed, 5);  // four kinds and the shared entry
}

TEST(CpuMeter, GivesTheShareOfOneCoreSinceTheCallBefore) {
  CpuMeter meter;
  EXPECT_EQ(meter.percent_since_last(seconds(5), seconds(1)), 0.0);
  EXPECT_DOUBLE_EQ(meter.percent_since_last(seconds(7), milliseconds(1500)), 25.0);
  EXPECT_EQ(meter.percent_since_last(seconds(7), milliseconds(1500)), 0.0);
}

TEST(OwnUsage, IsPlausible) {
  EXPECT_GT(resident_mb(), 0.5);
  EXPECT_LT(resident_mb(), 1000.0);
  EXPECT_GT(cpu_time().count(), 0);
}

TEST(Signals, EndTheProcessAtOnceWhereNothingIsToBeSaved) {
  const auto works = [](int before, int during) {
    stop_on_signals();
    if (before != 0) std::raise(before);
    end_on_signals();
    if (during != 0) std::raise(during);
    std::exit(0);
  };

  EXPECT_EXIT(works(0, SIGTERM), ::testing::KilledBySignal(SIGTERM), "");
  EXPECT_EXIT(works(0, SIGINT), ::testing::KilledBySignal(SIGINT), "");
  EXPECT_EXIT(works(SIGINT, 0), ::testing::KilledBySignal(SIGINT), "") << "it came before";
}

TEST(Signals, FirstOneAsksToStop) {
  const std::atomic<bool>& stop = stop_on_signals();
  EXPECT_FALSE(stop.load());
  std::raise(SIGTERM);
  EXPECT_TRUE(stop.load());
}

TEST(Leaving, AnAbortOfTheMiddlewareEndsTheProcessCleanly) {
  EXPECT_EXIT(
      {
        take_an_abort_for_the_end();
        std::abort();
      },
      ::testing::ExitedWithCode(0), "aborted while this process was leaving");
}

alignas(4096) const std::array<char, 2'000'000> kConstants{{1}};  // not all zero: stands in the program's file

int sum_of_constants() {
  int sum = 0;
  for (std::size_t i = 0; i < kConstants.size(); i += 1024) sum += static_cast<const volatile char&>(kConstants[i]);
  return sum;
}

TEST(Memory, ConstantsThatAreNotInUseAreNotResidentAndComeBack) {
  ASSERT_EQ(sum_of_constants(), 1);
  const double before_mb = resident_mb();
  give_back_unused_code();
  EXPECT_LT(resident_mb(), before_mb - 1.5);
  EXPECT_EQ(sum_of_constants(), 1);
}

}  // namespace
}  // namespace aisle::process
