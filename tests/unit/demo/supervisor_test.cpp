#include "tools/demo/supervisor.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

namespace aisle::demo {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr double kLimit_s = 30.0;

/// Shell scripts in place of the programs.
class Supervised : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("aisle-supervised-" + std::to_string(getpid()));
    fs::create_directories(folder_ / "logs");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void script(const std::string& program, const std::string& text) {
    std::ofstream(folder_ / program) << "#!/bin/sh\n" << text << "\n";
    fs::permissions(folder_ / program, fs::perms::owner_all);
  }
  static Process process(const std::string& name) {
    Process p;
    p.instance = name;
    p.program = "aisle-" + name;
    p.is_referee = name == "referee";
    return p;
  }
  RunOutcome run(const std::vector<std::string>& names, std::vector<KillOrder> kills = {}) {
    std::vector<Process> processes;
    for (const std::string& name : names) processes.push_back(process(name));
    ::testing::internal::CaptureStdout();
    Progress progress(false);
    Supervisor supervisor(std::move(processes), std::move(kills), folder_, folder_ / "logs", progress);
    const RunOutcome outcome = supervisor.run(stop_, kLimit_s);
    said_ = ::testing::internal::GetCapturedStdout();
    return outcome;
  }
  /// The referee ends with `code` as soon as `condition` holds.
  void referee_ends_when(const std::string& condition, int code) {
    script("aisle-referee", "echo '{\"t_s\":1.0,\"goals_reached\":2,\"goals_expected\":3}'\nuntil " + condition +
                                "; do sleep 0.02; done\necho the table\nexit " + std::to_string(code));
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
  std::atomic<bool> stop_{false};
  std::string said_;
};

const char* const kObedient = "trap 'exit 0' TERM\nwhile :; do sleep 0.02; done";

TEST_F(Supervised, HandsOnTheVerdictAndStopsAllCleanly) {
  referee_ends_when("true", 1);
  script("aisle-map", "echo begun >> " + file("begun") + "\n" + kObedient);
  referee_ends_when("[ -e " + file("begun") + " ]", 1);
  const RunOutcome outcome = run({"referee", "map"});
  EXPECT_EQ(outcome.referee_code, 1);
  EXPECT_EQ(outcome.stopped_cleanly, 1);
  EXPECT_EQ(outcome.stopped_uncleanly, 0);
  EXPECT_EQ(outcome.unexpected_deaths, 0);
  EXPECT_THAT(said_, HasSubstr("2 of 3 goals reached"));
  EXPECT_THAT(said_, HasSubstr("the table"));
}

TEST_F(Supervised, RestartsOnceWhatDiesByItselfAndShowsItsLastWords) {
  script("aisle-map", "echo x >> " + file("starts") + "\necho 'no disk left' >&2\nexit 3");
  referee_ends_when("[ \"$(wc -l < " + file("starts") + " 2>/dev/null)\" = 2 ] && sleep 0.3", 0);
  const RunOutcome outcome = run({"referee", "map"});
  EXPECT_EQ(outcome.unexpected_deaths, 2);
  ASSERT_EQ(outcome.deaths.size(), 2u);
  EXPECT_EQ(outcome.deaths[0].ending, "exit code 3");
  EXPECT_EQ(outcome.deaths[0].last_words, "no disk left");
  EXPECT_FALSE(outcome.deaths[0].while_stopping);
  EXPECT_THAT(said_, HasSubstr("map ended by itself with exit code 3, is restarted: no disk left"));
  EXPECT_THAT(said_, HasSubstr("map ended by itself with exit code 3, and stays down"));
}

TEST_F(Supervised, KillsAndRestartsAsOrdered) {
  script("aisle-map", "echo x >> " + file("starts") + "\n" + kObedient);
  referee_ends_when("[ \"$(wc -l < " + file("starts") + " 2>/dev/null)\" = 2 ]", 0);
  const RunOutcome outcome = run({"referee", "map"}, {{"map", 0.3, 0.1}});
  EXPECT_EQ(outcome.kills, 1);
  EXPECT_EQ(outcome.unexpected_deaths, 0);
  EXPECT_EQ(outcome.referee_code, 0);
}

TEST_F(Supervised, KillsWhatDoesNotStopAndSaysSo) {
  script("aisle-map", "trap '' TERM\necho begun >> " + file("begun") + "\nwhile :; do sleep 0.02; done");
  referee_ends_when("[ -e " + file("begun") + " ]", 0);
  const RunOutcome outcome = run({"referee", "map"});
  EXPECT_EQ(outcome.stopped_uncleanly, 1);
  ASSERT_EQ(outcome.deaths.size(), 1u);
  EXPECT_TRUE(outcome.deaths[0].while_stopping);
  EXPECT_THAT(said_, HasSubstr("map did not stop within 2 s"));
}

TEST_F(Supervised, ReportsAProgramThatIsNotThere) {
  referee_ends_when("[ -e " + file("never") + " ] || sleep 0.4", 0);
  const RunOutcome outcome = run({"referee", "map"});
  EXPECT_GE(outcome.unexpected_deaths, 1);
  EXPECT_THAT(said_, HasSubstr("map ended by itself with exit code 127"));
}

TEST_F(Supervised, LetsTheRefereeFinishWhenAPersonStopsTheRun) {
  script("aisle-referee", "trap 'echo finished; exit 1' TERM\nwhile :; do sleep 0.02; done");
  script("aisle-map", kObedient);
  stop_ = true;
  // Until the scripts have set their traps a SIGTERM ends them at once: either way the run is over, with a verdict that
  // is no pass.
  const RunOutcome outcome = run({"referee", "map"});
  EXPECT_EQ(outcome.referee_code, 1);
}

}  // namespace
}  // namespace aisle::demo
