// One trial gives one row, whatever it runs.
#include "tools/lab/sweep/trial_runner.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "common/config/reader.hpp"
#include "tools/lab/sweep/drive_rows.hpp"
#include "tools/lab/sweep/plan_rows.hpp"
#include "tools/lab/sweep/run_sweep.hpp"

namespace aisle::lab {
namespace {

using testing::HasSubstr;

bool never() { return false; }

/// Without what differs from run to run.
Row steady(Row row) {
  for (const char* key : {"time_us", "compute_us_mean", "compute_us_p99"}) row.erase(key);
  return row;
}

std::vector<Row> rows_of(const Sweep& sweep, int workers) {
  const TrialRunner runner(sweep);
  std::vector<Row> rows;
  SweepRun how{workers, never, [&](const Row& row) { rows.push_back(steady(row)); }};
  run_sweep(
      trials_of(sweep, runner.queries()), {},
      [&](const Trial& trial, const std::function<bool()>& stop) { return runner.run(trial, stop); }, how);
  return rows;
}

TEST(TrialRunner, PlansWithTheTrialsParameters) {
  Sweep sweep;
  sweep.kinds = {"wang-1"};
  sweep.planners = {"wang"};
  sweep.seeds = {1, 2, 3};
  sweep.vary = {parse_variation("", "wang.passes=none/collinear,line-of-sight")};

  const std::vector<Row> rows = rows_of(sweep, 2);
  ASSERT_EQ(rows.size(), 6U);
  for (std::size_t i = 0; i < rows.size(); i += 2) {
    EXPECT_EQ(rows[i]["outcome"], "found");
    EXPECT_EQ(rows[i]["global.wang.passes"], "none");
    EXPECT_GT(rows[i]["nodes"], rows[i + 1]["nodes"]) << "passes take nodes out";
    EXPECT_EQ(rows[i]["expanded"], rows[i + 1]["expanded"]) << "the search is the same";
  }
  EXPECT_EQ(rows, rows_of(sweep, 1)) << "one worker or two, the same rows";
}

TEST(TrialRunner, HasColumnsForWhatItsRowsHold) {
  Sweep sweep;
  sweep.kinds = {"wang-1"};
  sweep.planners = {"wang"};
  sweep.vary = {parse_variation("", "wang.log_base=2/10")};
  const TrialRunner runner(sweep);
  const Row row = *runner.run(trials_of(sweep, runner.queries()).front(), never);

  std::vector<std::string> columns = runner.leading_columns();
  for (const std::string& column : plan_columns()) columns.push_back(column);
  EXPECT_EQ(columns_of({row}), columns);
  EXPECT_EQ(row["global.wang.log_base"], 2.0);
}

class OwnMap : public testing::Test {
 protected:
  OwnMap() : file_(std::filesystem::temp_directory_path() / ("aisle-own-" + std::to_string(getpid()) + ".txt")) {
    std::ofstream(file_) << "........\n.S......\n....#...\n....#.T.\n........\n";
    sweep_.maps = {{file_}};
    sweep_.planners = {"astar"};
    sweep_.drives = true;
  }
  ~OwnMap() override { std::filesystem::remove(file_); }

  std::filesystem::path file_;
  Sweep sweep_;
};

TEST_F(OwnMap, IsDrivenToTheSameTraceByOneWorkerOrTwo) {
  sweep_.seeds = {1, 2};
  const std::vector<Row> rows = rows_of(sweep_, 2);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["goals_reached"], 1);
  EXPECT_EQ(rows[0]["contacts"], 0);
  EXPECT_GT(rows[0]["distance_m"], 5.0);
  EXPECT_EQ(rows, rows_of(sweep_, 1));
}

TEST_F(OwnMap, RefusesAStartInAWallWithTheMapAndThePlace) {
  sweep_.maps[0].start = Place{{4.5, 2.5}};
  try {
    rows_of(sweep_, 1);
    FAIL();
  } catch (const config::BadInput& error) {
    EXPECT_THAT(error.what(), HasSubstr(".txt: the start (4.50, 2.50) has no room for a vehicle of radius 0.35 m"));
  }
}

TEST_F(OwnMap, ChangesTheFingerprintWhenItsCellsOrAValueChange) {
  const auto print = [&] { return fingerprint(sweep_, trials_of(sweep_, {1})); };
  const std::string before = print();
  EXPECT_EQ(print(), before);
  sweep_.set = {parse_parameter("", "wang.alpha=0.1")};
  EXPECT_NE(print(), before);
  sweep_.set.clear();
  std::ofstream(file_, std::ios::app) << "........\n";
  EXPECT_NE(print(), before);
}

}  // namespace
}  // namespace aisle::lab
