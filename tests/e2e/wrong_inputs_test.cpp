// What a person sees who gives a program something wrong: one line that names it, and the exit code for it.
#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace aisle::e2e {
namespace {

namespace fs = std::filesystem;
using test_support::ChildProcess;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::chrono::seconds kLimit{10};
constexpr int kBadInput = 2;
constexpr int kEnvironment = 3;

struct Answer {
  int code{-1};
  std::string text;
};

class WrongInputs : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("aisle-wrong-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    write("hall.txt", "##########\n#........#\n#........#\n##########\n");
    write("good.yaml", "map: hall.txt\nvehicles:\n  - {id: agv-1, start: [2.0, 1.5, 0.0]}\n");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static Answer ask(const std::string& program, const std::vector<std::string>& arguments) {
    std::vector<std::string> command{test_support::program(program)};
    command.insert(command.end(), arguments.begin(), arguments.end());
    ChildProcess process(command);
    Answer answer;
    answer.code = process.wait(kLimit).value_or(-1);
    answer.text = process.out() + process.err();
    return answer;
  }

  fs::path folder_;
};

/// Each with the least that it needs to start.
struct Program {
  std::string name;
  std::vector<std::string> arguments;
};
std::vector<Program> services() {
  return {{"aisle-map", {}},
          {"aisle-global-planner", {}},
          {"aisle-obstacle-tracker", {}},
          {"aisle-local-planner", {"--agv", "agv-1"}},
          {"aisle-fake-vehicle", {"--agv", "agv-1"}},
          {"aisle-fake-world", {}},
          {"aisle-dispatcher", {}}};
}

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(WrongInputs, AnUnknownFlagIsNamedByEveryProgram) {
  std::vector<Program> all = services();
  all.push_back({"aisle-referee", {"--scenario", "any.yaml"}});
  all.push_back({"aisle-demo", {}});
  all.push_back({"aisle", {"fleet"}});
  for (const Program& program : all) {
    const Answer answer = ask(program.name, with(program.arguments, {"--domian", "7"}));
    EXPECT_EQ(answer.code, kBadInput) << program.name << ": " << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("--domian")) << program.name;
  }
}

TEST_F(WrongInputs, AnUnknownKeyIsNamedWithFileAndLine) {
  write("service.yaml", "log_level: info\nno_such_key: 1\n");
  for (const Program& program : services()) {
    const Answer answer = ask(program.name, with(program.arguments, {"--config", path("service.yaml")}));
    EXPECT_EQ(answer.code, kBadInput) << program.name << ": " << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("service.yaml:2")) << program.name;
    EXPECT_THAT(answer.text, HasSubstr("no_such_key")) << program.name;
  }
}

TEST_F(WrongInputs, AMissingConfigFileIsNamed) {
  for (const Program& program : services()) {
    const Answer answer = ask(program.name, with(program.arguments, {"--config", path("none.yaml")}));
    EXPECT_EQ(answer.code, kBadInput) << program.name << ": " << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("none.yaml")) << program.name;
  }
}

TEST_F(WrongInputs, AMissingVehicleIdIsNamed) {
  for (const char* program : {"aisle-local-planner", "aisle-fake-vehicle"}) {
    const Answer answer = ask(program, {});
    EXPECT_EQ(answer.code, kBadInput) << program << ": " << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("--agv")) << program;
  }
}

TEST_F(WrongInputs, AScenarioThatIsNotThereIsNamed) {
  for (const Program& program : std::vector<Program>{{"aisle-map", {}},
                                                     {"aisle-fake-world", {}},
                                                     {"aisle-dispatcher", {}},
                                                     {"aisle-referee", {}},
                                                     {"aisle-fake-vehicle", {"--agv", "agv-1"}}}) {
    const Answer answer =
        ask(program.name, with(program.arguments, {"--interface", "127.0.0.1", "--scenario", path("none.yaml")}));
    EXPECT_EQ(answer.code, kBadInput) << program.name << ": " << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("none.yaml")) << program.name;
  }
}

TEST_F(WrongInputs, ABadScenarioIsNamedWithItsLine) {
  write("bad.yaml", "map: hall.txt\nvehicles:\n  - {id: agv-1, start: [2.0, 1.5, 0.0], max_sped_mps: 1.0}\n");
  for (const Program& program : std::vector<Program>{{"aisle-map", {}},
                                                     {"aisle-fake-world", {}},
                                                     {"aisle-dispatcher", {}},
                                                     {"aisle-referee", {}},
                                                     {"aisle-fake-vehicle", {"--agv", "agv-1"}}}) {
    const Answer answer =
        ask(program.name, with(program.arguments, {"--interface", "127.0.0.1", "--scenario", path("bad.yaml")}));
    EXPECT_EQ(answer.code, kBadInput) << program.name << ": " << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("bad.yaml:3")) << program.name;
    EXPECT_THAT(answer.text, HasSubstr("max_speed_mps")) << program.name;
  }
  const Answer demo = ask("aisle-demo", {path("bad.yaml"), "--out", path("out")});
  EXPECT_EQ(demo.code, kBadInput) << demo.text;
  EXPECT_THAT(demo.text, HasSubstr("bad.yaml:3"));
}

TEST_F(WrongInputs, AMapThatIsNotThereIsNamed) {
  write("mapless.yaml", "map: nowhere.yaml\nvehicles:\n  - {id: agv-1, start: [2.0, 1.5, 0.0]}\n");
  for (const char* program : {"aisle-map", "aisle-referee"}) {
    const Answer answer = ask(program, {"--interface", "127.0.0.1", "--scenario", path("mapless.yaml")});
    EXPECT_EQ(answer.code, kBadInput) << program << ": " << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("nowhere.yaml")) << program;
  }
}

TEST_F(WrongInputs, AVehicleThatTheScenarioDoesNotHaveIsNamed) {
  const Answer answer =
      ask("aisle-fake-vehicle", {"--interface", "127.0.0.1", "--agv", "agv-9", "--scenario", path("good.yaml")});
  EXPECT_EQ(answer.code, kBadInput) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("agv-9"));
  EXPECT_THAT(answer.text, HasSubstr("agv-1"));
}

TEST_F(WrongInputs, AnAddressThatThisHostDoesNotHaveIsTheEnvironmentsFault) {
  for (const Program& program : services()) {
    const Answer answer = ask(program.name, with(program.arguments, {"--interface", "203.0.113.9"}));
    EXPECT_EQ(answer.code, kEnvironment) << program.name << ": " << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("203.0.113.9")) << program.name;
  }
}

TEST_F(WrongInputs, TheDemoNamesWhatItCannotRun) {
  const Answer scenario = ask("aisle-demo", {"crosing"});
  EXPECT_EQ(scenario.code, kBadInput);
  EXPECT_THAT(scenario.text, HasSubstr("did you mean 'crossing'"));
  const Answer kill = ask("aisle-demo", {path("good.yaml"), "--kill", "mop@3", "--out", path("out")});
  EXPECT_EQ(kill.code, kBadInput) << kill.text;
  EXPECT_THAT(kill.text, HasSubstr("did you mean 'map'"));
  const Answer form = ask("aisle-demo", {path("good.yaml"), "--kill", "map", "--out", path("out")});
  EXPECT_EQ(form.code, kBadInput) << form.text;
  EXPECT_THAT(form.text, HasSubstr("SERVICE@SECONDS"));
  EXPECT_FALSE(fs::exists(folder_ / "out")) << "nothing is written for a run that never starts";
}

}  // namespace
}  // namespace aisle::e2e
