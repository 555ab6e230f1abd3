#include "tools/lab/tracking/trial.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numeric>
#include <random>

#include "common/grid/line_of_sight.hpp"
#include "common/kinematics/vehicle_model.hpp"

namespace aisle::tracking {
namespace {

using geometry::Body;
using geometry::Point2;
using geometry::Pose2;
using obstacle_tracker::KnownVehicle;
using obstacle_tracker::Scan;

constexpr double kRound_s = 0.1;       // every vehicle scans once; then the trackers are judged
constexpr double kRemembered_s = 1.0;  // a person counts this long after a ray touched it
constexpr double kRangeMin_m = 0.05;
constexpr time::Stamp kStart = std::chrono::hours(1);  // clocks do not begin at 0

/// Computing time of this thread.
double thread_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// The value below which `part` of them lie; 0 of none.
double percentile(std::vector<double> values, double part) {
  if (values.empty()) return 0.0;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// One run: vehicles scan in turn, evenly spread over a round; every contestant gets every scan, and after each round
/// what it says is compared with the truth.
class Trial {
 public:
  Trial(Scene& scene, const Sensing& sensing, std::uint64_t seed,
        const std::vector<std::unique_ptr<Contestant>>& contestants)
      : scene_(scene), sensing_(sensing), random_(seed), contestants_(contestants), clearance_(scene.walls()) {
    scorers_.assign(contestants.size(), Scorer(kRound_s));
    took_ms_.resize(contestants.size());
  }

  /// Round by round: every vehicle scans once, then all contestants are judged.
  std::vector<Row> run(double longest_s, const std::function<void(const Glance&)>& watch) {
    const auto vehicles = std::max<std::size_t>(1, scene_.vehicles());
    const double until_s = std::min(longest_s, scene_.duration_s());

    for (int round = 1; kRound_s * (round + 1) <= until_s; ++round) {
      for (std::size_t v = 0; v < vehicles; ++v) {
        t_s_ = kRound_s * (round + static_cast<double>(v) / static_cast<double>(vehicles));
        truth_ = scene_.at(t_s_);
        if (v < scene_.vehicles()) hand_out(scan_of(v));
      }

      judge(watch);
    }

    return rows();
  }

 private:
  /// Seconds of the trial on the contestants' clock.
  time::Stamp stamp(double t_s) const { return kStart + time::from_seconds(t_s); }

  /// Gaussian, zero mean.
  double draw(double sigma) { return sigma > 0.0 ? sigma * normal_(random_) : 0.0; }

  /// With the error of a vehicle's localisation.
  Pose2 believed(const Pose2& base_in_map) {
    return {base_in_map.x + draw(sensing_.pose_noise_m), base_in_map.y + draw(sensing_.pose_noise_m),
            geometry::wrap(base_in_map.yaw + draw(sensing_.yaw_noise_rad))};
  }

  /// What the ray of vehicle `own` meets `ago_s` before now; notes the person that it touches.
  double cast(std::size_t own, const Pose2& base_in_map, double bearing_rad, double ago_s) {
    const Point2 from = base_in_map.position();
    double range_m = grid::cast_ray(scene_.walls(), from, bearing_rad, sensing_.range_m);
    Body disc;

    const auto shorten = [&](const Body& body) {
      const double hit_m = geometry::ray_hit_m(body, from, bearing_rad, sensing_.range_m);
      if (hit_m >= range_m) return false;
      range_m = hit_m;
      return true;
    };

    for (std::size_t v = 0; v < truth_.vehicles.size(); ++v) {
      if (v == own) continue;
      disc.base_in_map = kinematics::advance(truth_.vehicles[v].base_in_map, truth_.vehicles[v].twist, -ago_s);
      disc.radius_m = truth_.vehicles[v].radius_m;
      shorten(disc);
    }

    for (const Body& block : truth_.blocks) shorten(block);

    const Walking* touched = nullptr;
    for (const Walking& person : truth_.people) {
      const Point2 then = person.position_in_map - ago_s * person.velocity_in_map;
      if (geometry::distance(from, then) > range_m + person.radius_m) continue;

      disc.base_in_map = {then.x, then.y, 0.0};
      disc.radius_m = person.radius_m;
      if (shorten(disc)) touched = &person;
    }

    if (touched != nullptr) touched_s_[touched->id] = t_s_;
    return range_m;
  }

  /// The sweep of vehicle `v` that ends now.
  Scan scan_of(std::size_t v) {
    const Carrier& carrier = truth_.vehicles[v];
    const Pose2 at_first = kinematics::advance(carrier.base_in_map, carrier.twist, -sensing_.sweep_s);
    Scan scan;

    scan.agv_id = carrier.agv_id;
    scan.stamp = stamp(t_s_ - sensing_.sweep_s);
    scan.base_in_map = believed(at_first);
    scan.position_sigma_m = sensing_.pose_noise_m;
    scan.yaw_sigma_rad = sensing_.yaw_noise_rad;
    scan.twist = carrier.twist;
    scan.sweep_s = sensing_.sweep_s;
    scan.angle_step_rad = 2.0 * geometry::kPi / sensing_.rays;
    scan.range_min_m = kRangeMin_m;
    scan.range_max_m = sensing_.range_m;

    // Each ray from the pose of its own moment: the vehicle drives on during the sweep.
    for (int ray = 0; ray < sensing_.rays; ++ray) {
      const double since_s = sensing_.sweep_s * ray / (sensing_.rays - 1);
      const Pose2 base = kinematics::advance(at_first, carrier.twist, since_s);
      const double bearing_rad = base.yaw + ray * scan.angle_step_rad;
      double range_m = cast(v, base, bearing_rad, sensing_.sweep_s - since_s);

      if (range_m < sensing_.range_m)
        range_m = std::clamp(range_m + draw(sensing_.range_noise_m), kRangeMin_m, sensing_.range_m);

      scan.ranges_m.push_back(static_cast<float>(range_m));
    }

    return scan;
  }

  /// Gives the scan to every contestant, with what the fleet says of its vehicles, and measures the time.
  void hand_out(const Scan& scan) {
    std::vector<KnownVehicle> known;
    for (const Carrier& carrier : truth_.vehicles) {
      known.push_back({carrier.agv_id, false, carrier.radius_m, 0.0, 0.0, believed(carrier.base_in_map), carrier.twist,
                       stamp(t_s_)});
    }

    for (std::size_t c = 0; c < contestants_.size(); ++c) {
      const double begun_ms = thread_ms();
      contestants_[c]->take(scan, known, clearance_, stamp(t_s_));
      took_ms_[c].push_back(thread_ms() - begun_ms);
    }
  }

  /// The truth, as the scorers need it.
  std::vector<Person> people() {
    std::vector<Person> people;
    for (const Walking& person : truth_.people) {
      const auto touched = touched_s_.find(person.id);
      const bool is_counted = touched != touched_s_.end() && t_s_ - touched->second < kRemembered_s;

      people.push_back({person.id, person.position_in_map, person.velocity_in_map, is_counted});
      ++present_;
      if (is_counted) ++seen_;
    }

    return people;
  }

  /// Compares what every contestant says now with the truth.
  void judge(const std::function<void(const Glance&)>& watch) {
    constexpr double kBlockMargin_m = 0.5;  // discs that cover a block are no claims of people
    const std::vector<Person> there = people();
    std::vector<std::vector<fleet::Track>> tracks;

    for (std::size_t c = 0; c < contestants_.size(); ++c) {
      tracks.push_back(contestants_[c]->tracks(stamp(t_s_)));

      std::vector<fleet::Track> claims;
      for (const fleet::Track& track : tracks.back()) {
        const bool is_block = std::any_of(truth_.blocks.begin(), truth_.blocks.end(), [&](const Body& block) {
          return geometry::distance_m(block, track.position_in_map) < kBlockMargin_m;
        });

        if (!is_block) claims.push_back(track);
      }

      scorers_[c].look(there, claims);
    }

    if (watch) watch({t_s_, truth_, tracks});
  }

  /// A row for each contestant.
  std::vector<Row> rows() const {
    std::vector<Row> rows;
    for (std::size_t c = 0; c < contestants_.size(); ++c) {
      rows.push_back({contestants_[c]->name(), scorers_[c].score(),
                      present_ > 0 ? static_cast<double>(seen_) / static_cast<double>(present_) : 0.0,
                      percentile(took_ms_[c], 0.5), percentile(took_ms_[c], 0.99),
                      t_s_ > 0.0 ? 1e-3 * std::accumulate(took_ms_[c].begin(), took_ms_[c].end(), 0.0) / t_s_ : 0.0});
    }

    return rows;
  }

  Scene& scene_;
  Sensing sensing_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  const std::vector<std::unique_ptr<Contestant>>& contestants_;
  grid::ClearanceField clearance_;
  std::vector<Scorer> scorers_;
  std::vector<std::vector<double>> took_ms_;
  Moment truth_;
  double t_s_{0.0};
  std::map<int, double> touched_s_;
  std::int64_t present_{0}, seen_{0};
};

}  // namespace

std::vector<Row> run_trial(Scene& scene, const Sensing& sensing, std::uint64_t seed,
                           const std::vector<std::unique_ptr<Contestant>>& contestants, double longest_s,
                           const std::function<void(const Glance&)>& watch) {
  return Trial(scene, sensing, seed, contestants).run(longest_s, watch);
}

}  // namespace aisle::tracking
