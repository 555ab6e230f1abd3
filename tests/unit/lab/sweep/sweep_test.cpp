// Which trials a sweep has, and what is refused before the first one.
#include "tools/lab/sweep/sweep.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/support/refusal.hpp"

namespace aisle::lab {
namespace {

using test_support::refusal_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Sweep over_kind() {
  Sweep sweep;
  sweep.kinds = {"wang-1"};
  sweep.planners = {"wang", "astar"};
  return sweep;
}

TEST(Sweep, HasATrialForEachCombinationTheLastParameterFastest) {
  Sweep sweep = over_kind();
  sweep.seeds = {1, 2};
  sweep.vary = {parse_variation("", "wang.passes=none/collinear"), parse_variation("", "wang.distance_weight=0/1/2")};
  const std::vector<Trial> trials = trials_of(sweep, {1});
  ASSERT_EQ(trials.size(), 2U * (6U + 1U)) << "astar has no parameters of wang's";
  EXPECT_THAT(trials[1].values, ElementsAre(ParameterValue{Side::kGlobal, "wang", "passes", "none"},
                                            ParameterValue{Side::kGlobal, "wang", "distance_weight", "1"}));
  EXPECT_EQ(trials[6].planner, "astar");
  EXPECT_TRUE(trials[6].values.empty());
  EXPECT_EQ(trials[7].seed, 2U);
  for (std::size_t i = 0; i < trials.size(); ++i) EXPECT_EQ(trials[i].index, i);
}

TEST(Sweep, AsksEachQueryOfAMap) {
  Sweep sweep;
  sweep.maps.resize(2);
  sweep.planners = {"astar"};
  sweep.kinds = {"wang-1"};
  sweep.seeds = {1, 2, 3};
  const std::vector<Trial> trials = trials_of(sweep, {3, 1, 1});
  EXPECT_EQ(trials.size(), 3U + 1U + 3U) << "a path over a file's map is the same for every seed";
  EXPECT_EQ(trials[2].query, 2U);
  EXPECT_EQ(trials[3].subject, 1U);
}

TEST(Sweep, DrivesEveryLocalPlanner) {
  Sweep sweep = over_kind();
  sweep.drives = true;
  sweep.locals = {"wang", "dwa"};
  sweep.vary = {parse_variation("", "wang.alpha=0.05/0.1"), parse_variation("", "local-planner.horizon_s=2/3")};
  EXPECT_EQ(trials_of(sweep, {1}).size(), 2U * (4U + 2U));
}

TEST(Sweep, IsRefusedWithWhatToDo) {
  const auto refused = [](const auto& change) {
    Sweep sweep = over_kind();
    change(sweep);
    return refusal_of([&] { check(sweep); });
  };
  EXPECT_EQ(refused([](Sweep&) {}), "accepted");
  EXPECT_THAT(refused([](Sweep& it) { it.kinds.clear(); }), HasSubstr("give --map FILE, --kind NAME"));
  EXPECT_THAT(refused([](Sweep& it) { it.kinds = {"wnag-1"}; }), HasSubstr("did you mean 'wang-1'?"));
  EXPECT_THAT(refused([](Sweep& it) { it.planners = {"astra"}; }), HasSubstr("did you mean 'astar'?"));
  EXPECT_THAT(refused([](Sweep& it) { it.planners.clear(); }), HasSubstr("give --planner"));
  EXPECT_THAT(refused([](Sweep& it) { it.scenarios = {"crossing"}; }), HasSubstr("give --drive too"));
  EXPECT_THAT(refused([](Sweep& it) { it.as_printed = true; }), HasSubstr("give --drive too"));
  EXPECT_THAT(refused([](Sweep& it) { it.vary = {parse_variation("", "wu.passes=none")}; }),
              HasSubstr("another global planner"));
  EXPECT_THAT(refused([](Sweep& it) {
                it.vary = {parse_variation("", "wang.log_base=2/3")};
                it.set = {parse_parameter("", "wang.log_base=4")};
              }),
              HasSubstr("is also given by --set"));
  EXPECT_THAT(refused([](Sweep& it) {
                it.kinds.clear();
                it.maps.resize(1);
                it.seeds = {1, 2};
              }),
              HasSubstr("the same for every seed"));
}

TEST(Sweep, IsRefusedWhereSomethingIsGivenTwice) {
  const auto refused = [](const auto& change) {
    Sweep sweep = over_kind();
    change(sweep);
    return refusal_of([&] { check(sweep); });
  };
  EXPECT_EQ(refused([](Sweep& it) {
              it.vary = {parse_variation("", "wang.log_base=2/3"), parse_variation("", "global.wang.log_base=4")};
            }),
            "--vary: global.wang.log_base is given twice: give it once");
  EXPECT_THAT(refused([](Sweep& it) { it.vary = {parse_variation("", "wang.log_base=2/3/2")}; }),
              HasSubstr("global.wang.log_base: 2 is given twice"));
  EXPECT_THAT(refused([](Sweep& it) {
                it.planners = {"astar", "wang", "astar"};
              }),
              HasSubstr("--planner: astar is given twice"));
  EXPECT_THAT(refused([](Sweep& it) { it.locals = {"wang", "wang"}; }), HasSubstr("--local: wang is given twice"));
  EXPECT_THAT(refused([](Sweep& it) { it.seeds = {1, 2, 1}; }), HasSubstr("--seeds: 1 is given twice"));
  EXPECT_THAT(refused([](Sweep& it) { it.kinds = {"wang-1", "wang-1"}; }), HasSubstr("--kind: wang-1 is given twice"));
}

/// Each would take terabytes.
TEST(Sweep, IsRefusedForTooManyTrialsBeforeTheyAreMade) {
  std::string values = "wang.log_base=2";
  for (int i = 0; i < 999; ++i) values += fmt::format("/{}", 3 + i * 0.001);
  Sweep sweep = over_kind();
  sweep.vary = {parse_variation("", values), parse_variation("", values), parse_variation("", values),
                parse_variation("", values)};
  EXPECT_THAT(refusal_of([&] { trials_of(sweep, {1}); }), HasSubstr("at most 10000000 trials"));

  sweep.vary.resize(1);
  sweep.seeds = parse_seeds("", "1-1000000");
  EXPECT_THAT(refusal_of([&] { trials_of(sweep, {1'000'000}); }), HasSubstr("at most 10000000 trials"));
  EXPECT_THAT(refusal_of([] { parse_seeds("--seeds", "1-1000000,1000001-2000000"); }), HasSubstr("at most 1000000"));
}

TEST(Sweep, TakesSeedsAsRangesAndLists) {
  EXPECT_THAT(parse_seeds("--seeds", "1-3,7"), ElementsAre(1, 2, 3, 7));
  for (const char* text : {"", "1-", "3-1", "a", "1,,2", "-1", "1-2-3", "99999999999"})
    EXPECT_THAT(refusal_of([&] { parse_seeds("--seeds", text); }), HasSubstr("write e.g. 1-30")) << text;
}

TEST(Sweep, ChecksEveryValueThatVaries) {
  EXPECT_THAT(parse_variation("--vary", "wang.passes=none/collinear,line-of-sight").values,
              ElementsAre("none", "collinear,line-of-sight"));
  EXPECT_THAT(refusal_of([] { parse_variation("--vary", "wang.alpha=0.1/-1"); }),
              HasSubstr("--vary: wang.alpha is a number from 0 to 100"));
  EXPECT_THAT(refusal_of([] { parse_variation("--vary", "wang.alpha"); }), HasSubstr("is not NAME.PARAMETER=VALUE/"));
}

class SweepFile : public testing::Test {
 protected:
  SweepFile() : file_(std::filesystem::temp_directory_path() / ("aisle-sweep-" + std::to_string(getpid()) + ".yaml")) {}
  ~SweepFile() override { std::filesystem::remove(file_); }

  Sweep read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_sweep(file_);
  }

  std::filesystem::path file_;
};

TEST_F(SweepFile, SaysAllThatTheFlagsSay) {
  const Sweep sweep = read(
      "drive: true\n"
      "maps: [{file: hall.png, resolution_m: 0.05, start: [1, 1], goal: [9, 7, 1.5]}]\n"
      "kinds: [wang-1]\nscenarios: [crossing]\nplanners: [wang]\nlocals: [wang, dwa]\nseeds: 1-3\n"
      "set: [wang.passes=none]\nvary: [{parameter: wang.alpha, values: [0.05, 0.1]}]\nvehicle_radius_m: 0.3\n");
  EXPECT_TRUE(sweep.drives);
  ASSERT_EQ(sweep.maps.size(), 1U);
  EXPECT_EQ(sweep.maps[0].map, file_.parent_path() / "hall.png") << "beside the file";
  EXPECT_EQ(sweep.maps[0].cell_m, 0.05);
  EXPECT_EQ(sweep.maps[0].goal->yaw_rad, 1.5);
  EXPECT_THAT(sweep.seeds, ElementsAre(1, 2, 3));
  ASSERT_EQ(sweep.vary.size(), 1U);
  EXPECT_THAT(sweep.vary[0].values, ElementsAre("0.05", "0.1"));
  EXPECT_EQ(sweep.set.front().full_name(), "global.wang.passes");
  EXPECT_EQ(sweep.vehicle_radius_m, 0.3);
}

TEST_F(SweepFile, IsRefusedWithItsLine) {
  EXPECT_THAT(refusal_of([&] { read("plannres: [wang]\n"); }), AllOf(HasSubstr(".yaml:1"), HasSubstr("planners")));
  EXPECT_THAT(refusal_of([&] { read("kinds: [wang-1]\nvary: [{parameter: wang.alhpa, values: [1]}]\ndrive: true\n"); }),
              AllOf(HasSubstr(".yaml:2"), HasSubstr("did you mean 'alpha'?")));
  EXPECT_THAT(refusal_of([&] { read("kinds: [wang-1]\nset: [astar.nothing=1]\n"); }),
              AllOf(HasSubstr("set: "), testing::Not(HasSubstr("set: set:"))));
  EXPECT_THAT(refusal_of([&] { read("maps: [{file: a.png, start: [1]}]\n"); }), HasSubstr("must be [X, Y]"));
}

}  // namespace
}  // namespace aisle::lab
