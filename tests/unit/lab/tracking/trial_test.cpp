#include "tools/lab/tracking/trial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "common/config/reader.hpp"

namespace aisle::tracking {
namespace {

/// A file with three people who walk for 10 s, two of them past each other; removed at the end.
class PeopleFile {
 public:
  PeopleFile()
      : name_(testing::TempDir() + "people-" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".txt") {
    std::ofstream out(name_);
    for (int frame = 0; frame <= 250; frame += 10) {
      const double t_s = frame / 25.0;
      out << frame << " 1 " << t_s << " 0.0\n"
          << frame << " 2 " << 10.0 - t_s << " 0.9\n"
          << frame << " 3 " << t_s << " 9.0\n";
    }
  }
  ~PeopleFile() { std::remove(name_.c_str()); }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

/// For the least velocity error.
obstacle_tracker::TrackerParams exact() {
  obstacle_tracker::TrackerParams params;
  params.lifecycle.turn_speed_sigma_mps = 0.3;
  params.lifecycle.mark_gate = 6.0;
  return params;
}

std::vector<Row> rows_of(const std::string& file, bool drive, std::uint64_t seed) {
  const std::unique_ptr<Scene> scene = recorded_people(file, 2, drive);
  std::vector<std::unique_ptr<Contestant>> contestants;
  contestants.push_back(make_aisle(exact()));
  contestants.push_back(make_nearest_neighbour());
  return run_trial(*scene, {}, seed, contestants);
}

TEST(Trial, FollowsThreeWalkersBetterThanTheBaseline) {
  const PeopleFile file;
  for (const bool drive : {false, true}) {
    const std::vector<Row> rows = rows_of(file.name(), drive, 1);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].tracker, obstacle_tracker::MotionModel{}.filter);
    EXPECT_GT(rows[0].score.mota, 0.9) << drive;
    EXPECT_LT(rows[0].score.motp_m, 0.12) << drive;
    EXPECT_GT(rows[0].score.idf1, 0.85) << drive;
    EXPECT_LT(rows[0].score.velocity_rms_mps, 0.25) << drive;
    EXPECT_GT(rows[0].coverage, 0.95) << drive;
    EXPECT_LT(rows[0].score.motp_m, rows[1].score.motp_m) << drive;
    EXPECT_LT(rows[0].score.velocity_rms_mps, rows[1].score.velocity_rms_mps) << drive;
  }
}

TEST(Trial, IsTheSameForTheSameSeed) {
  const PeopleFile file;
  const Score a = rows_of(file.name(), true, 5)[0].score;
  const Score b = rows_of(file.name(), true, 5)[0].score;
  const Score other = rows_of(file.name(), true, 6)[0].score;
  EXPECT_EQ(a.motp_m, b.motp_m);
  EXPECT_NE(a.motp_m, other.motp_m);
}

TEST(Trial, SaysWhichFileIsBad) { EXPECT_THROW(recorded_people("/nowhere/people.txt", 2, false), config::BadInput); }

}  // namespace
}  // namespace aisle::tracking
