// The obstacle tracker under a fleet's load: 20 vehicles that scan at 10 Hz among 30 people, all of its filters beside
// a plain tracker (nearest neighbour) on the same scans: share of a core (CPU time over simulated time) and ms a scan.
// Then an hour of simulated time for the memory: the scans again and again, with the stamps moved on; resident memory
// after 10 minutes against after 60.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tools/lab/tracking/trial.hpp"

namespace {

using namespace aisle;
using geometry::Point2;
using obstacle_tracker::KnownVehicle;
using obstacle_tracker::Scan;

constexpr int kVehicles = 20;
constexpr int kPeople = 30;
constexpr double kLoad_s = 20.0;
constexpr int kVehiclesOfTheHour = 4;
constexpr double kHour_s = 3600.0;

double cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0.0;
  double resident = 0.0;

  statm >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// A hall of 36 x 24 m with pillars; vehicles drive circles, people walk to and fro.
class Hall final : public tracking::Scene {
 public:
  /// 30 people, each on a line of its own through the hall.
  Hall() : walls_(grid::Geometry{720, 480, 0.05, {}}) {
    for (int y = 0; y < 480; ++y) {
      for (int x = 0; x < 720; ++x) {
        const bool is_border = x == 0 || y == 0 || x == 719 || y == 479;
        if (is_border || (x % 120 < 10 && y % 120 < 10)) walls_.set({x, y}, grid::Occupancy::kOccupied);
      }
    }

    std::mt19937 random(7);
    std::uniform_real_distribution<double> x(1.5, 34.5), y(1.5, 22.5), part(0.0, 1.0);

    for (Leg& leg : legs_)
      leg = {{x(random), y(random)}, {x(random), y(random)}, 0.6 + 0.9 * part(random), 20.0 * part(random)};
  }

  const grid::OccupancyGrid& walls() const override { return walls_; }
  double duration_s() const override { return 1e9; }
  std::size_t vehicles() const override { return kVehicles; }

  /// Everything is a function of time: circles for vehicles, to and fro for people.
  tracking::Moment at(double t_s) override {
    tracking::Moment moment;

    // Vehicles drive in circles.
    for (int v = 0; v < kVehicles; ++v) {
      constexpr double kRadius_m = 1.4;
      constexpr double kSpeed_mps = 0.8;
      const double angle = kSpeed_mps / kRadius_m * t_s + v;
      const int row = v / 5;
      const double shift_m = v < 10 ? 0.0 : 3.0;
      const Point2 middle{3.25 + 6.0 * (v % 5) + shift_m, 3.25 + 5.4 * row};
      tracking::Carrier carrier;

      carrier.agv_id = "agv-" + std::to_string(v);
      carrier.base_in_map = {middle.x + kRadius_m * std::cos(angle), middle.y + kRadius_m * std::sin(angle),
                             geometry::wrap(angle + geometry::kPi / 2.0)};
      carrier.twist = {kSpeed_mps, kSpeed_mps / kRadius_m, 0.0};
      moment.vehicles.push_back(carrier);
    }

    // People walk to and fro.
    for (int p = 0; p < kPeople; ++p) {
      const Leg& leg = legs_[static_cast<std::size_t>(p)];
      const double length_m = std::max(1.0, geometry::distance(leg.from, leg.to));
      const double way_m = std::fmod(leg.speed_mps * (t_s + leg.ahead_s), 2.0 * length_m);
      const bool goes_back = way_m > length_m;
      const Point2 direction = (1.0 / length_m) * (leg.to - leg.from);
      const double along_m = goes_back ? 2.0 * length_m - way_m : way_m;

      moment.people.push_back(
          {p + 1, leg.from + along_m * direction, (goes_back ? -leg.speed_mps : leg.speed_mps) * direction});
    }

    return moment;
  }

 private:
  struct Leg {
    Point2 from, to;
    double speed_mps;
    double ahead_s;
  };

  grid::OccupancyGrid walls_;
  std::array<Leg, kPeople> legs_;
};

/// Keeps the scans of the first vehicles, to take them again.
class Recorder final : public tracking::Contestant {
 public:
  struct Taken {
    Scan scan;
    std::vector<KnownVehicle> vehicles;
    time::Stamp now;
  };

  std::string name() const override { return "recorder"; }

  void take(const Scan& scan, const std::vector<KnownVehicle>& vehicles, const grid::ClearanceField&,
            time::Stamp now) override {
    for (int v = 0; v < kVehiclesOfTheHour; ++v) {
      if (scan.agv_id == "agv-" + std::to_string(v)) taken_.push_back({scan, vehicles, now});
    }
  }

  std::vector<fleet::Track> tracks(time::Stamp) const override { return {}; }
  const std::vector<Taken>& taken() const { return taken_; }

 private:
  std::vector<Taken> taken_;
};

/// All trackers and the recorder on the same scans.
void share_of_a_core(Hall& hall, Recorder*& recorder, std::vector<std::unique_ptr<tracking::Contestant>>& contestants) {
  for (const obstacle_tracker::Filter& filter : obstacle_tracker::all_filters())
    contestants.push_back(tracking::make_aisle(filter.name));

  contestants.push_back(tracking::make_nearest_neighbour());

  auto own = std::make_unique<Recorder>();
  recorder = own.get();
  contestants.push_back(std::move(own));

  const std::vector<tracking::Row> rows = tracking::run_trial(hall, {}, 1, contestants, kLoad_s);
  std::printf("%d vehicles at 10 Hz, %d people, %.0f s simulated\n", kVehicles, kPeople, kLoad_s);
  std::printf("%-18s %16s %14s %12s %12s %7s\n", "tracker", "share of a core", "to the plain", "scan ms p50",
              "scan ms p99", "MOTA");

  const double plain = rows[rows.size() - 2].core_share;
  for (const tracking::Row& row : rows) {
    if (row.tracker == recorder->name()) continue;

    std::printf("%-18s %16.4f %14.2f %12.4f %12.4f %7.3f", row.tracker.c_str(), row.core_share, row.core_share / plain,
                row.scan_ms_p50, row.scan_ms_p99, row.score.mota);
    std::printf(row.tracker == "nearest-neighbour"                ? "\n"
                : row.core_share < 0.30 && row.scan_ms_p99 <= 5.0 ? "  goal 0.30, 5 ms: met\n"
                                                                  : "  goal 0.30, 5 ms: missed\n");
  }
}

/// The recorded scans again and again, with later stamps, until an hour has passed; memory must not
/// grow after ten minutes.
void memory_of_an_hour(Hall& hall, const std::vector<Recorder::Taken>& taken) {
  const grid::ClearanceField clearance(hall.walls());
  obstacle_tracker::Tracker tracker;
  const double begun_s = cpu_s();
  double after_ten_mb = 0.0;
  std::size_t most = 0;
  double simulated_s = 0.0;
  Scan scan;
  std::vector<KnownVehicle> vehicles;

  for (int round = 0; simulated_s < kHour_s; ++round) {
    const time::Stamp later = time::from_seconds(kLoad_s * round);
    for (const Recorder::Taken& one : taken) {
      scan = one.scan;
      scan.stamp += later;
      vehicles = one.vehicles;
      for (KnownVehicle& vehicle : vehicles) vehicle.stamp += later;
      static_cast<void>(tracker.take(scan, vehicles, &clearance, one.now + later));
      most = std::max(most, tracker.tracks_held());
    }

    simulated_s = kLoad_s * (round + 1);
    if (after_ten_mb == 0.0 && simulated_s >= 600.0) after_ten_mb = resident_mb();
  }

  const double grown_mb = resident_mb() - after_ten_mb;
  std::printf(
      "\nAn hour of %d vehicles' scans, %llu used, %llu dropped, in %.1f s CPU: resident %.2f MB after 10 min, %+.2f "
      "MB after 60; at most %zu tracks held: %s\n",
      kVehiclesOfTheHour, static_cast<unsigned long long>(tracker.scans_used()),
      static_cast<unsigned long long>(tracker.scans_dropped()), cpu_s() - begun_s, after_ten_mb, grown_mb, most,
      grown_mb < 0.5 ? "flat" : "GROWS");
}

}  // namespace

int main() {
  Hall hall;
  Recorder* recorder = nullptr;
  std::vector<std::unique_ptr<tracking::Contestant>> contestants;

  share_of_a_core(hall, recorder, contestants);
  memory_of_an_hour(hall, recorder->taken());

  return 0;
}
