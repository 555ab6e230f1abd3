#include "tools/lab/tracking/scoring.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "services/obstacle-tracker/core/association.hpp"

namespace aisle::tracking {

using obstacle_tracker::Candidate;

namespace {

/// `part` of `whole` in [0, 1]; 0 of nothing.
double share(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

}  // namespace

/// For each person the index of its claim, or -1. First what still matches keeps matching, as CLEAR MOT asks: it is the
/// change of a pair that counts as a switch. Then the rest is assigned with the least total distance.
std::vector<int> Scorer::match(const std::vector<Person>& people, const std::vector<Track>& claims) const {
  std::vector<int> claim_of(people.size(), -1);
  std::vector<char> is_taken(claims.size(), 0);

  for (std::size_t p = 0; p < people.size(); ++p) {
    const auto history = histories_.find(people[p].id);
    if (history == histories_.end() || !history->second.has_track) continue;

    for (std::size_t c = 0; c < claims.size(); ++c) {
      if (is_taken[c] || claims[c].id != history->second.track) continue;
      if (geometry::distance(people[p].position_in_map, claims[c].position_in_map) > gate_m_) continue;
      claim_of[p] = static_cast<int>(c);
      is_taken[c] = 1;
    }
  }

  std::vector<Candidate> candidates;
  for (std::size_t p = 0; p < people.size(); ++p) {
    for (std::size_t c = 0; c < claims.size() && claim_of[p] < 0; ++c) {
      const double away_m = geometry::distance(people[p].position_in_map, claims[c].position_in_map);
      if (!is_taken[c] && away_m <= gate_m_) candidates.push_back({static_cast<int>(p), static_cast<int>(c), away_m});
    }
  }

  // To be left alone costs much more than any distance: as many pairs as possible, and among those the nearest.
  const std::vector<int> rest = obstacle_tracker::assign(static_cast<int>(people.size()),
                                                         static_cast<int>(claims.size()), candidates, 1e3 * gate_m_);
  for (std::size_t p = 0; p < people.size(); ++p) {
    if (claim_of[p] < 0) claim_of[p] = rest[p];
  }

  return claim_of;
}

void Scorer::Weighing::add(double nees) {
  constexpr double kQuantile95 = 5.991;  // chi-square, 2 degrees of freedom
  sum += nees;
  ++count;
  if (nees <= kQuantile95) ++inside;
}

Honesty Scorer::Weighing::honesty() const {
  return {count > 0 ? sum / static_cast<double>(count) : 0.0, share(inside, count)};
}

/// Normalised estimation error squared: e^T P^-1 e, of place and of velocity apart. Claims without a covariance say
/// nothing about how sure they are.
void Scorer::weigh(const Person& person, const Track& claim) {
  const Eigen::Matrix4d covariance = Eigen::Map<const Eigen::Matrix4d>(claim.covariance.data());
  if (covariance.diagonal().minCoeff() <= 0.0) return;

  const geometry::Point2 away = claim.position_in_map - person.position_in_map;
  const geometry::Point2 faster = claim.velocity_in_map - person.velocity_in_map;
  const Eigen::Vector2d place(away.x, away.y);
  const Eigen::Vector2d velocity(faster.x, faster.y);

  place_.add(place.dot(covariance.topLeftCorner<2, 2>().inverse() * place));
  velocity_.add(velocity.dot(covariance.bottomRightCorner<2, 2>().inverse() * velocity));
}

/// Counts one person at one moment; `claim` is none when it was missed.
void Scorer::judge(const Person& person, const Track* claim) {
  constexpr double kOldEnough_s = 1.0;
  History& history = histories_[person.id];

  if (person.is_counted) ++people_;

  if (claim == nullptr) {
    if (!person.is_counted) return;

    ++misses_;
    if (history.has_track) history.is_lost = true;
    if (!history.has_track) ++history.waited;

    return;
  }

  if (person.is_counted) {
    if (history.has_track && history.track != claim->id) ++switches_;
    if (history.is_lost) ++fragments_;
    history.is_lost = false;
    ++matches_;
    distance_sum_m_ += geometry::distance(person.position_in_map, claim->position_in_map);

    if (claim->age_s > kOldEnough_s) {
      const geometry::Point2 error = claim->velocity_in_map - person.velocity_in_map;
      velocity_squares_ += geometry::dot(error, error);
      ++velocities_;
      weigh(person, *claim);
    }
  }

  history.has_track = true;
  history.track = claim->id;
}

/// Counts each claim: right, false, or of a person that does not count; and how long which ids were together, for IDF1.
void Scorer::note_ids(const std::vector<Person>& people, const std::vector<Track>& claims,
                      const std::vector<int>& claim_of) {
  std::vector<int> person_of(claims.size(), -1);
  for (std::size_t p = 0; p < people.size(); ++p) {
    if (claim_of[p] >= 0) person_of[static_cast<std::size_t>(claim_of[p])] = static_cast<int>(p);
  }

  for (std::size_t c = 0; c < claims.size(); ++c) {
    Life& life = lives_[claims[c].id];
    ++life.claimed;
    if (person_of[c] >= 0) ++life.right;

    if (person_of[c] >= 0 && !people[static_cast<std::size_t>(person_of[c])].is_counted) continue;

    ++claims_;
    if (person_of[c] < 0) ++false_claims_;

    for (const Person& person : people) {
      if (!person.is_counted || geometry::distance(person.position_in_map, claims[c].position_in_map) > gate_m_)
        continue;
      ++together_[{person.id, claims[c].id}];
    }
  }
}

/// Matches, then judges people, then claims.
void Scorer::look(const std::vector<Person>& people, const std::vector<Track>& claims) {
  ++moments_;

  const std::vector<int> claim_of = match(people, claims);
  for (std::size_t p = 0; p < people.size(); ++p) {
    judge(people[p], claim_of[p] >= 0 ? &claims[static_cast<std::size_t>(claim_of[p])] : nullptr);
  }

  note_ids(people, claims, claim_of);
}

/// The most moments that one lasting pairing of people and tracks can explain: an assignment with the moments that two
/// ids spent together as gain (Ristani et al. 2016).
std::int64_t Scorer::ids_explained() const {
  std::map<int, int> rows;
  std::map<std::uint64_t, int> columns;
  std::vector<Candidate> candidates;

  for (const auto& [ids, moments] : together_) {
    const int row = rows.try_emplace(ids.first, static_cast<int>(rows.size())).first->second;
    const int column = columns.try_emplace(ids.second, static_cast<int>(columns.size())).first->second;
    candidates.push_back({row, column, -static_cast<double>(moments)});
  }

  const std::vector<int> track_of =
      obstacle_tracker::assign(static_cast<int>(rows.size()), static_cast<int>(columns.size()), candidates, 0.0);

  std::int64_t explained = 0;
  for (const Candidate& candidate : candidates) {
    if (track_of[static_cast<std::size_t>(candidate.row)] == candidate.column)
      explained += std::llround(-candidate.cost);
  }

  return explained;
}

/// CLEAR MOT: MOTA = 1 - (misses + false claims + switches) / people, MOTP = mean distance of the
/// pairs. IDF1 = 2 IDTP / (people + claims), with IDTP the moments that ids_explained() finds.
Score Scorer::score() const {
  Score score;
  score.people = people_;
  score.misses = misses_;
  score.false_claims = false_claims_;
  score.id_switches = switches_;
  score.fragments = fragments_;
  score.mota = 1.0 - share(misses_ + false_claims_ + switches_, people_);
  score.motp_m = matches_ > 0 ? distance_sum_m_ / static_cast<double>(matches_) : 0.0;
  score.idf1 = share(2 * ids_explained(), people_ + claims_);
  score.velocity_rms_mps = velocities_ > 0 ? std::sqrt(velocity_squares_ / static_cast<double>(velocities_)) : 0.0;
  score.place = place_.honesty();
  score.velocity = velocity_.honesty();

  int found = 0;
  for (const auto& [id, history] : histories_) {
    if (!history.has_track) continue;
    ++found;
    score.latency_scans += history.waited;
  }

  if (found > 0) score.latency_scans /= found;

  int false_tracks = 0;
  for (const auto& [id, life] : lives_) {
    if (life.right > 0) continue;
    ++false_tracks;
    score.longest_false_s = std::max(score.longest_false_s, life.claimed * period_s_);
  }

  if (moments_ > 0) score.false_tracks_per_min = 60.0 * false_tracks / (moments_ * period_s_);
  return score;
}

}  // namespace aisle::tracking
