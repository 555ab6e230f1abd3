#include "tools/lab/tracking/scoring.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace aisle::tracking {
namespace {

constexpr double kPeriod_s = 0.1;

Person person(int id, double x, bool is_counted = true) { return {id, {x, 0.0}, {1.0, 0.0}, is_counted}; }
Track claim(std::uint64_t id, double x, double age_s = 0.5) {
  Track track;
  track.id = id;
  track.position_in_map = {x, 0.0};
  track.velocity_in_map = {1.0, 0.0};
  track.age_s = age_s;
  return track;
}

TEST(Scoring, GivesFullMarksToThePerfect) {
  Scorer scorer(kPeriod_s);
  for (int i = 0; i < 10; ++i) scorer.look({person(1, 0.1 * i), person(2, 5.0)}, {claim(7, 0.1 * i), claim(8, 5.0)});
  const Score score = scorer.score();
  EXPECT_DOUBLE_EQ(score.mota, 1.0);
  EXPECT_DOUBLE_EQ(score.motp_m, 0.0);
  EXPECT_DOUBLE_EQ(score.idf1, 1.0);
  EXPECT_EQ(score.id_switches, 0);
  EXPECT_EQ(score.fragments, 0);
  EXPECT_EQ(score.people, 20);
}

TEST(Scoring, CountsMissesFalseClaimsAndDistance) {
  Scorer scorer(kPeriod_s);
  scorer.look({person(1, 0.0), person(2, 5.0)}, {claim(7, 0.2)});                 // one missed
  scorer.look({person(1, 0.0), person(2, 5.0)}, {claim(7, 0.1), claim(9, 9.0)});  // one missed, one false
  const Score score = scorer.score();
  EXPECT_EQ(score.misses, 2);
  EXPECT_EQ(score.false_claims, 1);
  EXPECT_DOUBLE_EQ(score.mota, 1.0 - 3.0 / 4.0);
  EXPECT_NEAR(score.motp_m, 0.15, 1e-12);
}

TEST(Scoring, TakesNoPairBeyondTheGate) {
  Scorer scorer(kPeriod_s, 0.5);
  scorer.look({person(1, 0.0)}, {claim(7, 0.51)});
  EXPECT_EQ(scorer.score().misses, 1);
  EXPECT_EQ(scorer.score().false_claims, 1);
  EXPECT_DOUBLE_EQ(scorer.score().mota, -1.0);
}

TEST(Scoring, KeepsAPairWhenAnotherTrackComesNearer) {
  Scorer scorer(kPeriod_s);
  scorer.look({person(1, 0.0)}, {claim(7, 0.3)});
  scorer.look({person(1, 0.0)}, {claim(7, 0.3), claim(8, 0.0)});
  EXPECT_EQ(scorer.score().id_switches, 0);
  EXPECT_EQ(scorer.score().false_claims, 1);
}

TEST(Scoring, PairsAsManyAsItCan) {
  Scorer scorer(kPeriod_s);
  scorer.look({person(1, 0.0), person(2, 0.4)},
              {claim(7, 0.35), claim(8, 0.8)});  // the nearest pair would leave person 1 alone
  EXPECT_EQ(scorer.score().misses, 0);
}

TEST(Scoring, CountsASwitchWhenTwoSwapAndAfterAGap) {
  Scorer scorer(kPeriod_s);
  scorer.look({person(1, 0.0), person(2, 3.0)}, {claim(7, 0.0), claim(8, 3.0)});
  scorer.look({person(1, 0.0), person(2, 3.0)}, {claim(8, 0.0), claim(7, 3.0)});
  EXPECT_EQ(scorer.score().id_switches, 2);
  EXPECT_EQ(scorer.score().fragments, 0);
  scorer.look({person(1, 0.0)}, {});
  scorer.look({person(1, 0.0)}, {claim(9, 0.0)});
  EXPECT_EQ(scorer.score().id_switches, 3);
  EXPECT_EQ(scorer.score().fragments, 1);
}

TEST(Scoring, ExplainsIdsByOneLastingPairing) {
  Scorer scorer(kPeriod_s);
  for (int i = 0; i < 6; ++i) scorer.look({person(1, 0.0)}, {claim(7, 0.0)});
  for (int i = 0; i < 4; ++i) scorer.look({person(1, 0.0)}, {claim(8, 0.0)});
  EXPECT_DOUBLE_EQ(scorer.score().idf1, 2.0 * 6.0 / (10.0 + 10.0));
  EXPECT_DOUBLE_EQ(scorer.score().mota, 1.0 - 1.0 / 10.0);
}

TEST(Scoring, BlamesNobodyForWhoIsNotCounted) {
  Scorer scorer(kPeriod_s);
  scorer.look({person(1, 0.0, false)}, {});
  scorer.look({person(1, 0.0, false)}, {claim(7, 0.1)});  // neither right nor wrong
  EXPECT_EQ(scorer.score().people, 0);
  EXPECT_EQ(scorer.score().misses, 0);
  EXPECT_EQ(scorer.score().false_claims, 0);
  EXPECT_EQ(scorer.score().false_tracks_per_min, 0.0);
}

TEST(Scoring, CountsFalseTracksByIdAndHowLongTheyLast) {
  Scorer scorer(kPeriod_s);
  for (int i = 0; i < 600; ++i) {  // a minute
    std::vector<Track> claims{claim(7, 0.0)};
    if (i < 5) claims.push_back(claim(8, 9.0));
    if (i >= 100 && i < 103) claims.push_back(claim(9, 9.0));
    if (i == 300) claims.push_back(claim(7, 9.0));  // once right: not a false track
    scorer.look({person(1, 0.0)}, claims);
  }
  EXPECT_NEAR(scorer.score().false_tracks_per_min, 2.0, 1e-9);
  EXPECT_NEAR(scorer.score().longest_false_s, 0.5, 1e-9);
}

TEST(Scoring, MeasuresVelocityOfOldTracksAsAVector) {
  Scorer scorer(kPeriod_s);
  Track young = claim(7, 0.0, 1.0);
  young.velocity_in_map = {9.0, 9.0};
  scorer.look({person(1, 0.0)}, {young});
  Track old = claim(7, 0.0, 1.1);
  old.velocity_in_map = {1.3, 0.4};  // off by (0.3, 0.4)
  scorer.look({person(1, 0.0)}, {old});
  EXPECT_NEAR(scorer.score().velocity_rms_mps, 0.5, 1e-12);
}

TEST(Scoring, WeighsErrorsByTheCovarianceOfWhoSaysOne) {
  Scorer scorer(kPeriod_s);
  Track sure = claim(7, 0.2, 2.0);  // 0.2 m off in x, 0.3 m/s in vy
  sure.velocity_in_map = {1.0, 0.3};
  sure.covariance[0] = sure.covariance[5] = 0.1 * 0.1;
  sure.covariance[10] = sure.covariance[15] = 0.1 * 0.1;
  scorer.look({person(1, 0.0)}, {sure});
  scorer.look({person(1, 0.0)}, {claim(7, 0.1, 2.0)});  // says nothing
  sure.age_s = 0.5;
  scorer.look({person(1, 0.0)}, {sure});  // too young
  EXPECT_NEAR(scorer.score().place.mean, 4.0, 1e-9);
  EXPECT_NEAR(scorer.score().velocity.mean, 9.0, 1e-9);
  EXPECT_EQ(scorer.score().place.inside, 1.0);
  EXPECT_EQ(scorer.score().velocity.inside, 0.0);
}

TEST(Scoring, CountsHowManyScansTheFirstTrackTakes) {
  Scorer scorer(kPeriod_s);
  scorer.look({person(1, 0.0), person(2, 5.0)}, {claim(7, 0.0)});
  scorer.look({person(1, 0.0), person(2, 5.0)}, {claim(7, 0.0)});
  scorer.look({person(1, 0.0), person(2, 5.0)}, {claim(7, 0.0), claim(8, 5.0)});
  EXPECT_DOUBLE_EQ(scorer.score().latency_scans, 1.0);  // 0 and 2
}

}  // namespace
}  // namespace aisle::tracking
