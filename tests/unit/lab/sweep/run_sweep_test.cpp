// Trials on several threads give the same rows in the same order as on one.
#include "tools/lab/sweep/run_sweep.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <stdexcept>

namespace aisle::lab {
namespace {

std::vector<Trial> trials(std::size_t count) {
  std::vector<Trial> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i].index = i;
  return all;
}

std::optional<Row> squared(const Trial& trial, const std::function<bool()>&) {
  return Row{{"trial", trial.index}, {"square", trial.index * trial.index}};
}

SweepRun quiet(int workers, std::vector<std::size_t>& taken) {
  return {workers, [] { return false; }, [&taken](const Row& row) { taken.push_back(row["trial"]); }};
}

TEST(RunSweep, HandsRowsOverInOrderWhateverTheWorkers) {
  for (const int workers : {1, 2, 5}) {
    std::vector<std::size_t> taken;
    const std::vector<Row> rows = run_sweep(trials(40), {}, squared, quiet(workers, taken));
    ASSERT_EQ(rows.size(), 40U);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i]["square"], i * i);
      EXPECT_EQ(taken[i], i);
    }
  }
}

TEST(RunSweep, RunsOnlyWhatIsMissing) {
  std::atomic<int> runs{0};
  std::vector<std::size_t> taken;
  const std::map<std::size_t, Row> kept{{0, {{"trial", 0}, {"square", -1}}}, {2, {{"trial", 2}, {"square", -1}}}};
  const std::vector<Row> rows = run_sweep(
      trials(4), kept,
      [&](const Trial& trial, const std::function<bool()>& stop) {
        ++runs;
        return squared(trial, stop);
      },
      quiet(2, taken));
  EXPECT_EQ(runs, 2);
  EXPECT_THAT(taken, testing::ElementsAre(1U, 3U));
  EXPECT_EQ(rows[2]["square"], -1) << "kept as it was";
}

TEST(RunSweep, EndsWhenInterruptedWithTheRowsUntilThen) {
  std::atomic<int> runs{0};
  std::size_t taken = 0;
  SweepRun how{1, [&] { return runs >= 3; }, [&](const Row&) { ++taken; }};
  const std::vector<Row> rows = run_sweep(
      trials(100), {},
      [&](const Trial& trial, const std::function<bool()>& stop) {
        ++runs;
        return stop() ? std::nullopt : squared(trial, stop);
      },
      how);
  EXPECT_EQ(rows.size(), 2U);
  EXPECT_EQ(taken, 2U);
}

TEST(RunSweep, ThrowsWhatATrialThrowsAfterTheRowsBefore) {
  std::vector<std::size_t> taken;
  const auto run = [](const Trial& trial, const std::function<bool()>& stop) {
    if (trial.index == 3) throw std::runtime_error("in a wall");
    return squared(trial, stop);
  };
  EXPECT_THROW(run_sweep(trials(10), {}, run, quiet(2, taken)), std::runtime_error);
  EXPECT_THAT(taken, testing::ElementsAre(0U, 1U, 2U));
}

}  // namespace
}  // namespace aisle::lab
