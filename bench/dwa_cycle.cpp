// One control cycle of the dynamic window: 400 samples of 32 steps with all critics, among 0 to 500 boxes of the map and 0 to 50 tracks,
// beside a plain scalar version in the same run. Nanoseconds a trajectory point, medians of interleaved rounds, CPU time of the thread.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <vector>

#include "common/grid/clearance.hpp"
#include "services/local-planner/core/dwa.hpp"

namespace {

using namespace aisle;
using geometry::Point2;
using local_planner::Aim;
using local_planner::Mover;
using local_planner::Scene;

constexpr int kPoints = 400 * 32;
constexpr int kRounds = 15;
constexpr double kHallM = 20.0;

double cpu_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

/// A hall with boxes of 0.2 m, none within 0.6 m of where the vehicle is.
struct Place {
  std::vector<Point2> boxes;
  grid::ClearanceField clearance;
  std::vector<Mover> movers;
};

Place make_place(int boxes, int tracks) {
  std::mt19937 random(static_cast<unsigned>(1 + 7 * boxes + tracks));
  std::uniform_real_distribution<double> at(0.5, kHallM - 0.5), speed(-1.2, 1.2);
  const Point2 here{0.5 * kHallM, 0.5 * kHallM};
  const auto away = [&](double least_m) {
    for (;;) {
      const Point2 p{at(random), at(random)};
      if (geometry::distance(p, here) > least_m) return p;
    }
  };
  Place place;
  grid::OccupancyGrid grid(grid::Geometry{400, 400, 0.05, {}});
  for (int i = 0; i < boxes; ++i) {
    const Point2 p = away(0.8);
    place.boxes.push_back(p);
    const grid::Cell low = grid.geometry().cell_at(p);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x)
        if (grid.geometry().contains({low.x + x, low.y + y})) grid.set({low.x + x, low.y + y}, grid::Occupancy::kOccupied);
  }
  place.clearance = grid::ClearanceField(grid, 5.0);
  for (int i = 0; i < tracks; ++i) place.movers.push_back({away(1.2), {speed(random), speed(random)}, 0.25, 0.15, 0.2});
  return place;
}

local_planner::DwaSettings bench_settings() {
  local_planner::DwaSettings settings;
  settings.horizon_s = 3.2;
  settings.linear_samples = 20;
  settings.angular_samples = 19;        // and straight on
  return settings;
}

local_planner::Variant all_critics() {
  using namespace local_planner;
  Variant variant = wang();
  variant.critics = {{heading_critic, .1},       {clearance_critic, .1},           {velocity_critic, .1},         {sub_target_heading_critic, .1},
                     {path_distance_critic, .1}, {sub_target_distance_critic, .1}, {static_clearance_critic, .1}, {dynamic_clearance_critic, .1}};
  return variant;
}

Aim make_aim(const Scene& scene) {
  const Point2 here = scene.base_in_map.position();
  Aim aim;
  aim.target_in_map = here + Point2{1.8, 0.2};
  aim.sub_target_in_map = here + Point2{0.6, 0.0};
  for (double s = 0.0; s < 3.0; s += 0.2) aim.path_in_map.push_back(here + Point2{s, 0.05 * s});
  return aim;
}

double ours_ns(const Place& place, std::vector<double>& rounds) {
  static const std::vector<local_planner::PeerMotion> kNoPeers;
  const Scene scene{place.clearance, {0.5 * kHallM, 0.5 * kHallM, 0.0}, {0.6, 0.1, 0.0}, 0.35, {}, 1.2, place.movers, kNoPeers};
  const local_planner::Variant variant = all_critics();
  const Aim aim = make_aim(scene);
  constexpr int kTimes = 20;
  volatile double kept = 0.0;
  const double begin = cpu_ns();
  for (int i = 0; i < kTimes; ++i) kept = kept + choose(scene, aim, variant, bench_settings()).twist.linear_mps;
  rounds.push_back((cpu_ns() - begin) / kTimes / kPoints);
  return rounds.back();
}

/// As textbooks write it: every sample, every step, every box and track, with libm.
double plain_cycle(const Place& place) {
  double best = -1e18;
  double chosen = 0.0;
  for (int iv = 0; iv < 20; ++iv)
    for (int iw = 0; iw < 20; ++iw) {
      const double v = 0.24 + 0.03 * iv;
      const double w = -0.65 + 0.075 * iw;
      double x = 0.5 * kHallM, y = 0.5 * kHallM, yaw = 0.0, gap = 1e9;
      for (int k = 1; k <= 32; ++k) {
        x += v * std::cos(yaw) * 0.1, y += v * std::sin(yaw) * 0.1, yaw += w * 0.1;
        for (const Point2 box : place.boxes) gap = std::min(gap, std::hypot(x - box.x, y - box.y) - 0.45);
        for (const Mover& m : place.movers)
          gap = std::min(gap, std::hypot(x - m.position_in_map.x - 0.1 * k * m.velocity_in_map.x, y - m.position_in_map.y - 0.1 * k * m.velocity_in_map.y) - 0.6);
      }
      const double score = gap < 0.0 ? -1e18 : 0.2 * (3.14 - std::abs(std::atan2(10.2 - y, 11.8 - x) - yaw)) + 0.5 * std::min(gap, 1.0) + 0.3 * v;
      if (score > best) best = score, chosen = v;
    }
  return chosen;
}

void plain_ns(const Place& place, std::vector<double>& rounds) {
  volatile double kept = 0.0;
  const double begin = cpu_ns();
  kept = kept + plain_cycle(place);
  rounds.push_back((cpu_ns() - begin) / kPoints);
}

double share_of(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Row {
  int boxes, tracks;
  Place place;
  std::vector<double> ours, plain;
};

void goal(const char* what, double value, double most) { std::printf("  %-52s %6.2f, goal %.2f: %s\n", what, value, most, value <= most ? "met" : "missed"); }

}  // namespace

int main() {
  std::vector<Row> rows;
  for (const std::array<int, 2> of : {std::array<int, 2>{0, 0}, {10, 0}, {100, 0}, {500, 0}, {100, 10}, {100, 50}}) rows.push_back({of[0], of[1], make_place(of[0], of[1]), {}, {}});
  for (int round = 0; round < kRounds; ++round)
    for (Row& row : rows) {
      ours_ns(row.place, row.ours);
      plain_ns(row.place, row.plain);
    }
  std::printf("400 samples x 32 steps, disc, eight critics; ns a trajectory point\n  %6s %7s %8s %8s %8s %8s\n", "boxes", "tracks", "ours", "p99", "plain", "ratio");
  for (const Row& row : rows) {
    const double ours = share_of(row.ours, 0.5);
    const double plain = share_of(row.plain, 0.5);
    std::printf("  %6d %7d %8.2f %8.2f %8.2f %8.3f\n", row.boxes, row.tracks, ours, share_of(row.ours, 0.99), plain, ours / plain);
  }
  goal("ns a point, 100 boxes", share_of(rows[2].ours, 0.5), 10.0);
  goal("500 boxes to 10", share_of(rows[3].ours, 0.5) / share_of(rows[1].ours, 0.5), 1.1);
  goal("50 tracks to none", share_of(rows[5].ours, 0.5) / share_of(rows[2].ours, 0.5), 2.0);
}
