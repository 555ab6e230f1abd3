// One trial gives one row, whatever it runs.
#include "tools/lab/sweep/trial_runner.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "common/config/reader.hpp"
#include "tools/lab/driving/printed_drive.hpp"
#include "tools/lab/sweep/drive_rows.hpp"
#include "tools/lab/sweep/plan_rows.hpp"
#include "tools/lab/sweep/run_sweep.hpp"
#include "tools/sim/site.hpp"

namespace aisle::lab {
namespace {

using testing::AllOf;
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

std::string print_of(const Sweep& sweep) {
  const TrialRunner runner(sweep);
  return runner.fingerprint(trials_of(sweep, runner.queries()));
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

  EXPECT_EQ(columns_of({row}), runner.columns());
  std::vector<std::string> columns{"trial", "subject", "query", "seed", "planner", "global.wang.log_base"};
  for (const std::string& column : plan_columns()) columns.push_back(column);
  columns.emplace_back("refusal");
  EXPECT_EQ(runner.columns(), columns);
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

TEST_F(OwnMap, IsDrivenAsPrintedFromTheYawOfItsStart) {
  sweep_.as_printed = true;
  sweep_.maps[0].start = Place{{1.5, 3.5}, 1.5};
  const std::vector<Row> rows = rows_of(sweep_, 1);

  const Subject subject = read_subject(sweep_.maps[0]);
  const Query& query = subject.queries.front();
  const sim::Setup setup = printed_setup({subject.grid, query.start_in_map, query.goal_in_map},
                                         *local_planner::find_variant("wang"), "astar", 1.5);
  EXPECT_EQ(setup.scenario.vehicles.front().start_in_map.yaw, 1.5);
  sim::Totals totals;
  totals.add(sim::drive(setup).result);
  EXPECT_EQ(rows[0]["trace_hash"], drive_figures(totals, {})["trace_hash"]);

  sweep_.maps[0].start->yaw_rad.reset();
  EXPECT_NE(rows_of(sweep_, 1)[0]["trace_hash"], rows[0]["trace_hash"]);
}

TEST_F(OwnMap, HasARowForAStartInAWallWithTheMapAndThePlace) {
  sweep_.maps.push_back({file_, 0.0, Place{{4.5, 2.5}}});
  sweep_.maps.push_back({file_});
  const std::vector<Row> rows = rows_of(sweep_, 1);
  ASSERT_EQ(rows.size(), 3U) << "the trials after it are driven";
  EXPECT_THAT(rows[1]["refusal"].get<std::string>(),
              AllOf(HasSubstr(".txt: the start (4.50, 2.50) has no room for a vehicle of radius 0.35 m"),
                    HasSubstr("make the vehicle's radius smaller")));
  EXPECT_TRUE(rows[1]["goals_reached"].is_null());
  EXPECT_EQ(columns_of({rows[1]}), columns_of({rows[2]}));
  EXPECT_TRUE(rows[2]["refusal"].is_null());
  EXPECT_EQ(rows[2]["goals_reached"], 1);
}

TEST(TrialRunner, RefusesAScenarioThatIsNotThereBeforeTheFirstTrial) {
  Sweep sweep;
  sweep.drives = true;
  sweep.planners = {"astar"};
  sweep.scenarios = {"crossing", "nowhere.yaml"};
  EXPECT_THROW(TrialRunner{sweep}, config::BadInput);
}

TEST_F(OwnMap, ChangesTheFingerprintWhenItsCellsOrAValueChange) {
  const auto print = [&] { return print_of(sweep_); };
  const std::string before = print();
  EXPECT_EQ(print(), before);
  sweep_.set = {parse_parameter("", "wang.alpha=0.1")};
  EXPECT_NE(print(), before);
  sweep_.set.clear();
  std::ofstream(file_, std::ios::app) << "........\n";
  EXPECT_NE(print(), before);
}

/// Files in a folder of their own.
class Fingerprint : public testing::Test {
 protected:
  Fingerprint() : folder_(std::filesystem::temp_directory_path() / ("aisle-print-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    sweep_.planners = {"astar"};
  }
  ~Fingerprint() override { std::filesystem::remove_all(folder_); }

  void write(const char* name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  std::filesystem::path folder_;
  Sweep sweep_;
};

TEST_F(Fingerprint, ChangesWithThePictureOfARosMap) {
  const auto picture = [](char cell) { return "P5\n4 2\n255\n" + std::string("\xfe\xfe\xfe\xfe\xfe\xfe\xfe") + cell; };
  write("hall.yaml",
        "image: hall.pgm\nresolution: 1.0\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\n");
  write("hall.pgm", picture('\xfe'));
  sweep_.maps = {{folder_ / "hall.yaml", 0.0, Place{{0.5, 0.5}}, Place{{2.5, 0.5}}}};

  const std::string before = print_of(sweep_);
  EXPECT_EQ(print_of(sweep_), before);
  write("hall.pgm", picture('\0'));
  EXPECT_NE(print_of(sweep_), before);
}

TEST_F(Fingerprint, ChangesWithAScenarioFileAndItsMap) {
  const std::string scenario =
      "map: hall.txt\nmoving_ai_cell_m: 1.0\nduration_s: 5.0\n"
      "vehicles: [{id: agv-1, start: [1.5, 1.5, 0.0]}]\n";
  write("hall.txt", "....\n....\n....\n");
  write("hall.yaml", scenario);
  sweep_.scenarios = {(folder_ / "hall.yaml").string()};
  sweep_.drives = true;

  const std::string before = print_of(sweep_);
  EXPECT_EQ(print_of(sweep_), before);
  write("hall.txt", "...#\n....\n....\n");
  const std::string with_wall = print_of(sweep_);
  EXPECT_NE(with_wall, before);
  write("hall.yaml", scenario + "# another\n");
  EXPECT_NE(print_of(sweep_), with_wall);
}

}  // namespace
}  // namespace aisle::lab
