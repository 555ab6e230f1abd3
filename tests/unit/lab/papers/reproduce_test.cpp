#include "tools/lab/papers/reproduce.hpp"

#include <gmock/gmock.h>

#include <map>
#include <string>

#include "common/config/reader.hpp"
#include "services/local-planner/core/critic.hpp"

namespace aisle::lab {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

void silent(const std::string&) {}

std::vector<ReproducedRow> few(const std::vector<std::string>& tables, unsigned seed = 1) {
  Reproduction orders;
  orders.tables = tables;
  orders.maps = {12, seed};
  orders.drives = {0, seed};
  return reproduce(orders, silent);
}

const ReproducedRow& row_of(std::vector<ReproducedRow>&& rows, const std::string& name) = delete;  // it would dangle

const ReproducedRow& row_of(const std::vector<ReproducedRow>& rows, const std::string& name) {
  for (const ReproducedRow& row : rows)
    if (row.of->row == name) return row;
  throw std::logic_error("no row " + name);
}

PairedComparison difference(double low, double high, double reference = 10.0) {
  PairedComparison comparison;
  comparison.n = 200;
  comparison.mean_a = reference;
  comparison.mean_difference = 0.5 * (low + high);
  comparison.interval95 = {low, high};
  return comparison;
}

TEST(Judged, HoldsOnlyWhenTheIntervalExcludesZeroOnTheClaimedSide) {
  EXPECT_EQ(judged(ClaimedDirection::kLess, difference(-2.0, -1.0)), Verdict::kSameDirection);
  EXPECT_EQ(judged(ClaimedDirection::kLess, difference(-2.0, 0.1)), Verdict::kOtherDirection) << "it may be zero";
  EXPECT_EQ(judged(ClaimedDirection::kLess, difference(1.0, 2.0)), Verdict::kOtherDirection);
  EXPECT_EQ(judged(ClaimedDirection::kMore, difference(1.0, 2.0)), Verdict::kSameDirection);
  EXPECT_EQ(judged(ClaimedDirection::kMore, difference(-0.1, 2.0)), Verdict::kOtherDirection);
  EXPECT_EQ(judged(ClaimedDirection::kHoldsNot, difference(1.0, 2.0)), Verdict::kSameDirection);
  EXPECT_EQ(judged(ClaimedDirection::kHoldsNot, difference(-0.1, 2.0)), Verdict::kOtherDirection) << "it may be zero";
}

TEST(Judged, EqualityIsWithinOnePercent) {
  EXPECT_EQ(judged(ClaimedDirection::kEqual, difference(0.08, 0.1)), Verdict::kSameDirection);
  EXPECT_EQ(judged(ClaimedDirection::kEqual, difference(0.1, 0.12)), Verdict::kOtherDirection);
}

TEST(Judged, AClaimWithoutAReferenceHoldsFrom95PercentOn) {
  EXPECT_EQ(judged(ClaimedDirection::kHolds, 0.95), Verdict::kSameDirection);
  EXPECT_EQ(judged(ClaimedDirection::kHolds, 0.9), Verdict::kOtherDirection);
  EXPECT_EQ(judged(ClaimedDirection::kHoldsNot, 0.9), Verdict::kSameDirection);
  EXPECT_EQ(reason(ClaimedDirection::kHolds, 0.95), "");
  EXPECT_EQ(reason(ClaimedDirection::kHolds, 0.9), "so on 90.0 %, the bound is 95 %");
  EXPECT_EQ(reason(ClaimedDirection::kHoldsNot, 1.0), "so on 100.0 %, the bound is 95 %");
}

TEST(TablesNamed, AreOneTableAPaperOrAll) {
  EXPECT_THAT(tables_named("wang-2"), ElementsAre("WANG 2"));
  EXPECT_THAT(tables_named("WU figure 8"), ElementsAre("WU figure 8"));
  EXPECT_EQ(tables_named("all"), published_tables());
  EXPECT_THAT(tables_named("qu").front(), HasSubstr("QU"));
  try {
    tables_named("wnag-2");
    FAIL();
  } catch (const config::BadInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean wang-2?"));
  }
}

TEST(Reproduce, MakesEveryRowOfAPlanningTable) {
  const auto rows = few({"WANG 1"});
  ASSERT_EQ(rows.size(), 9U);
  const ReproducedRow& scope = row_of(rows, "Improved A* Algorithm: search scope, m2");
  EXPECT_EQ(scope.verdict, Verdict::kSameDirection);
  EXPECT_EQ(scope.n, 12U);
  EXPECT_LT(*scope.ours, *scope.reference);
  EXPECT_LT((*scope.interval95)[1], 0.0);
  const ReproducedRow& time = row_of(rows, "Traditional A* Algorithm: planning time");
  EXPECT_DOUBLE_EQ(*time.ours, 1.0) << "times are ratios to the first row";
  EXPECT_THAT(time.why, HasSubstr("printed 0.076; ours "));
}

TEST(Reproduce, IsTheSameForTheSameSeedButForTimes) {
  const auto once = few({"YU 3"}), again = few({"YU 3"}), other = few({"YU 3"}, 2);
  const std::string length = "A* algorithm with improved heuristic function: path length, m";
  EXPECT_EQ(row_of(once, length).ours, row_of(again, length).ours);
  EXPECT_NE(row_of(once, length).ours, row_of(other, length).ours);
}

TEST(Reproduce, LeavesNothingToGuessWhereARowCannotBeMade) {
  const auto rows = few({"YU 2"});
  const ReproducedRow& row = row_of(rows, "Cheng 2017 proposed improvements to A*: path length, m");
  EXPECT_EQ(row.verdict, Verdict::kNotComparable);
  EXPECT_FALSE(row.ours);
  EXPECT_THAT(row.why, HasSubstr("no formula"));
}

TEST(Reproduce, ComparesParametersWithThoseInUse) {
  const auto rows = few({"WU 1", "LI I"});
  EXPECT_EQ(row_of(rows, "maximum line velocity, m/s").verdict, Verdict::kSameDirection);
  EXPECT_EQ(row_of(rows, "minimum linear acceleration, m/s2").verdict, Verdict::kOtherDirection);
  EXPECT_THAT(row_of(rows, "minimum linear acceleration, m/s2").why, HasSubstr("never brake"));
  EXPECT_EQ(row_of(rows, "obstacle at N (orthogonal): remaining child nodes").ours, 6.0);
}

TEST(Reproduce, DoesNotCompareAParameterThatTheCodeHasNot) {
  const auto rows = few({"LI III", "QU 1", "WU 1", "WANG section 5"});
  for (const char* name : {"Smoothing factor sigma", "minimum line velocity, m/s", "Initial line speed, m/s",
                           "Initial angular velocity, deg/s", "sigma"}) {
    EXPECT_EQ(row_of(rows, name).verdict, Verdict::kNotComparable) << name;
    EXPECT_THAT(row_of(rows, name).why, StartsWith("no parameter of ours")) << name;
  }
  EXPECT_EQ(row_of(rows, "interval time dt, s").ours, local_planner::find_variant("wu")->printed.interval_s);
}

// Every verdict against the paper says why.
TEST(Reproduce, GivesAReasonForEveryOtherDirection) {
  const auto rows = few({"LI II", "LI V", "QU 2", "WANG 1", "WANG 2", "WU 2", "WU figure 8", "YU 2", "YU 3", "YU 4"});
  int others = 0;
  for (const ReproducedRow& row : rows) {
    if (row.verdict != Verdict::kOtherDirection || !row.reference) continue;
    ++others;
    EXPECT_THAT(row.why, AnyOf(HasSubstr("95 % interval"), HasSubstr("the means differ by more than 1 %")))
        << row.of->table << ", " << row.of->row;
  }
  EXPECT_GT(others, 0);

  const auto equal = few({"YU 2"});
  const ReproducedRow& turns = row_of(equal, "A* algorithm with improved heuristic function: turning points number");
  ASSERT_EQ(turns.of->claim, ClaimedDirection::kEqual);
  ASSERT_EQ(turns.verdict, Verdict::kOtherDirection);
  EXPECT_THAT(turns.why, HasSubstr("the means differ by more than 1 %"));
}

TEST(Reproduce, ShowsThatWusPathTurnsLess) {
  const auto rows = few({"WU figure 8"});
  const ReproducedRow& turns = row_of(rows, "improved A*: turns");
  EXPECT_EQ(turns.verdict, Verdict::kSameDirection);
  EXPECT_LT(*turns.ours, *turns.reference);
}

TEST(Reproduce, CountsEachClaimOnce) {
  const auto rows = few({"WU figure 8"});
  EXPECT_EQ(rows.size(), 4U);
  const VerdictCount counted = count(rows);
  EXPECT_EQ(counted.same_direction + counted.other_direction + counted.not_comparable, 3) << "without the reference";
}

TEST(ReproducedJson, HasAnObjectARow) {
  const auto rows = few({"QU 2"}, 3);
  const auto json = json_of(rows, 3);
  ASSERT_EQ(json.size(), 12U);
  for (const auto& object : json) {
    for (const char* key : {"table", "row", "published", "ours", "verdict", "why", "n", "interval95", "commit", "seed"})
      EXPECT_TRUE(object.contains(key)) << key;
    EXPECT_EQ(object["seed"], 3);
    EXPECT_EQ(object["interval95"].size(), 2U);
  }
  EXPECT_EQ(json[0]["published"], 8.0);
  EXPECT_EQ(json[4]["row"], "Map 1, Improving the A* algorithm: turning point optimization ratio");
  EXPECT_EQ(json[4]["published"], "75 %");
}

}  // namespace
}  // namespace aisle::lab
