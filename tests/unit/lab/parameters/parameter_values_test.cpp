// Parameters as a researcher types them, or writes them into a file.
#include "tools/lab/parameters/parameter_values.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "services/global-planner/core/variant.hpp"
#include "tests/support/refusal.hpp"

namespace aisle::lab {
namespace {

using test_support::refusal_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string refused(const std::string& text, std::optional<Side> only = {}) {
  return refusal_of([&] { parse_parameter("--set", text, only); });
}

TEST(ParameterValues, FindTheirSideByTheirName) {
  EXPECT_EQ(parse_parameter("--set", "wang.alpha=0.1").full_name(), "local.wang.alpha");
  EXPECT_EQ(parse_parameter("--set", "wang.log_base=2").full_name(), "global.wang.log_base");
  EXPECT_EQ(parse_parameter("--set", "wang.passes=collinear,line-of-sight").value, "collinear,line-of-sight");
}

TEST(ParameterValues, OfANameThatBothPlannersHaveNeedTheSide) {
  EXPECT_THAT(refused("yu.beta=0.4"), HasSubstr("write global.yu.beta or local.yu.beta"));
  EXPECT_EQ(parse_parameter("--set", "global.yu.beta=0.4").side, Side::kGlobal);
  EXPECT_EQ(parse_parameter("--set", "local.yu.beta=0.4").side, Side::kLocal);
  EXPECT_EQ(parse_parameter("--set", "yu.beta=0.4", Side::kGlobal).side, Side::kGlobal);
}

TEST(ParameterValues, AreRefusedWithTheNearestNameOrTheRange) {
  EXPECT_THAT(refused("wnag.alpha=1"), AllOf(HasSubstr("--set: no planner 'wnag'"), HasSubstr("did you mean 'wang'?")));
  EXPECT_THAT(refused("wang.alhpa=1"), HasSubstr("did you mean 'alpha'?"));
  EXPECT_THAT(refused("wang.alpha"), HasSubstr("is not NAME.PARAMETER=VALUE"));
  EXPECT_THAT(refused("wang=1"), HasSubstr("is not NAME.PARAMETER=VALUE"));
  EXPECT_THAT(refused("wang.alpha=-1"), HasSubstr("wang.alpha is a number from 0 to 100"));
  EXPECT_THAT(refused("wang.alpha= 1"), HasSubstr("is a number"));
  EXPECT_THAT(refused("wang.alpha=1x"), HasSubstr("is a number"));
  EXPECT_THAT(refused("wang.log_base=1"), HasSubstr("wang.log_base: '1' is no number from 1.1 to 1000"));
  EXPECT_THAT(refused("wang.passes=magic"), HasSubstr("'magic' is not one of"));
  EXPECT_THAT(refused("wang.target_rule=gaol"), HasSubstr("is not one of goal, nearest-path-point"));
  EXPECT_THAT(refused("global-planner.margin_m=9"), HasSubstr("not a number from 0 to 2"));
  EXPECT_THAT(refused("local-planner.linear_samples=3.5"), HasSubstr("not a whole number from 2 to 50"));
  EXPECT_THAT(refused("local.wang.alpha=0.1", Side::kGlobal), HasSubstr("only global planners are used here"));
}

TEST(ParameterValues, MakeThePlannersThatTheySay) {
  const std::vector<ParameterValue> values{parse_parameter("--set", "wang.alpha=0.1"),
                                           parse_parameter("--set", "wang.target_rule=path-nodes"),
                                           parse_parameter("--set", "wang.start_yaw_rad=1.5"),
                                           parse_parameter("--set", "wang.model=tricycle"),
                                           parse_parameter("--set", "wang.passes=none"),
                                           parse_parameter("--set", "local-planner.horizon_s=3"),
                                           parse_parameter("--set", "global-planner.margin_m=0.2")};
  const local_planner::Variant variant = local_variant(values, "wang");
  EXPECT_EQ(variant.critics.front().weight, 0.1);
  EXPECT_EQ(variant.printed.target_rule, local_planner::target_rules::path_nodes);
  EXPECT_EQ(variant.printed.start_yaw_rad, 1.5);
  EXPECT_EQ(variant.printed.model, kinematics::Model::kTricycle);
  EXPECT_EQ(local_variant(values, "wu").critics.front().weight, local_planner::find_variant("wu")->critics[0].weight);

  const global_planner::Parameters none_of_wu = global_parameters(values, "wu");
  EXPECT_NO_THROW(global_planner::find_variant("wu")->make(none_of_wu)) << "it got nothing of wang's";

  global_planner::FleetSettings fleet;
  local_planner::Settings local;
  set_settings(values, fleet, local);
  EXPECT_EQ(fleet.margin_m, 0.2);
  EXPECT_EQ(local.dwa.horizon_s, 3.0);
}

TEST(ParameterValues, ThatWouldChangeNothingAreRefused) {
  const auto refused_in = [](const std::string& text, const InUse& in_use) {
    return refusal_of([&] { check_in_use("--set", {parse_parameter("--set", text)}, in_use); });
  };
  const InUse ours{{"direct"}, {"wang"}};
  EXPECT_EQ(refused_in("wang.alpha=0.1", ours), "accepted");
  EXPECT_EQ(refused_in("local-planner.horizon_s=3", ours), "accepted");
  EXPECT_THAT(refused_in("wu.alpha=0.1", ours), HasSubstr("another local planner than is used here: wang"));
  EXPECT_THAT(refused_in("wang.log_base=2", ours), HasSubstr("another global planner than is used here: direct"));
  EXPECT_THAT(refused_in("wang.max_speed_mps=1", ours), HasSubstr("counts only with --paper-limits or --as-printed"));
  EXPECT_EQ(refused_in("wang.max_speed_mps=1", {{"direct"}, {"wang"}, true}), "accepted");
  EXPECT_THAT(refused_in("wang.radius_m=1", {{"direct"}, {"wang"}, true}), HasSubstr("counts only with --as-printed"));
  EXPECT_EQ(refused_in("wang.radius_m=1", {{"direct"}, {"wang"}, false, true}), "accepted");
  EXPECT_THAT(refused_in("global-planner.margin_m=0.2", {{"wang"}, {}}), HasSubstr("counts in drives only"));
}

class ParameterFile : public testing::Test {
 protected:
  ParameterFile()
      : file_(std::filesystem::temp_directory_path() / ("aisle-parameters-" + std::to_string(getpid()) + ".yaml")) {}
  ~ParameterFile() override { std::filesystem::remove(file_); }

  std::vector<ParameterValue> read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_parameter_file(file_);
  }

  std::filesystem::path file_;
};

TEST_F(ParameterFile, HoldsThemBySidePlannerAndName) {
  const std::vector<ParameterValue> values = read(
      "global:\n  wang: {log_base: 2, passes: none}\nlocal:\n  wang: {alpha: 0.1}\n  local-planner: {horizon_s: 3}\n");
  EXPECT_THAT(values, ElementsAre(ParameterValue{Side::kGlobal, "wang", "log_base", "2"},
                                  ParameterValue{Side::kGlobal, "wang", "passes", "none"},
                                  ParameterValue{Side::kLocal, "wang", "alpha", "0.1"},
                                  ParameterValue{Side::kLocal, "local-planner", "horizon_s", "3"}));
}

TEST_F(ParameterFile, IsRefusedWithLineAndNearestName) {
  EXPECT_THAT(refusal_of([&] { read("local:\n  wang: {alhpa: 0.1}\n"); }),
              AllOf(HasSubstr(".yaml:2: local.wang"), HasSubstr("alpha")));
  EXPECT_THAT(refusal_of([&] { read("local:\n  wnag: {alpha: 0.1}\n"); }), HasSubstr("wang"));
  EXPECT_THAT(refusal_of([&] { read("local:\n  wang: {alpha: -1}\n"); }),
              AllOf(HasSubstr(".yaml:2: local.wang.alpha"), HasSubstr("from 0 to 100")));
}

}  // namespace
}  // namespace aisle::lab
