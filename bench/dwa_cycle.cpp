// One control cycle of the dynamic window: 400 samples of 32 steps with all critics, among 0 to 500 boxes of the map
// and 0 to 50 tracks, for a disc, a rectangle and a forklift, beside a plain scalar version in the same run.
// Nanoseconds a trajectory point, CPU time of the thread, over the single cycles of interleaved rounds; the fastest
// tenth (p10) is what a machine does that nobody else uses, for what runs beside it shares cores and caches. After each
// cycle a loop of multiplications runs about as long: it always takes the same steps, so how far its p99 is from its
// median is the machine's doing. `dwa_cycle FILE` writes the rows as CSV too; `dwa_cycle row N CYCLES` only runs that
// row's cycles, for a profiler that counts instructions.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "common/geometry/footprint.hpp"
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
constexpr int kCycles = 20;  // of ours a round
constexpr double kHallM = 20.0;

/// From the vehicle: 3.84 m of way, 1.8 m of outline and 1 m of clearance that a critic may ask for.
constexpr double kFarM = 7.0;

/// Computing time of this thread.
double cpu_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

/// What drives: its outline, and how it moves.
struct VehicleKind {
  const char* name;
  geometry::CoveringDiscs discs;
  kinematics::Model model;
  double room_m;  // from its base to the next box: to start without a contact
};

VehicleKind disc() {
  return {"disc", geometry::covering_discs(geometry::disc(0.35)), kinematics::Model::kDifferential, 0.8};
}

VehicleKind rectangle() {
  return {"rectangle", geometry::covering_discs(geometry::rectangle(2.4, 1.1, 0.4)), kinematics::Model::kDifferential,
          2.2};
}

VehicleKind forklift() {
  return {"forklift", geometry::covering_discs(geometry::rectangle(2.4, 1.1, 0.4)), kinematics::Model::kTricycle, 2.2};
}

/// A hall with boxes of 0.2 m, none at the vehicle.
struct Place {
  std::vector<Point2> boxes;
  grid::ClearanceField clearance;
  std::vector<Mover> movers;
};

/// `boxes` in all, of which `anywhere` may stand near the vehicle; the others stand where no sample
/// leads and no disc is looked up.
Place make_place(int boxes, int anywhere, int tracks, double room_m) {
  std::mt19937 random(static_cast<unsigned>(1 + 7 * anywhere + tracks));
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
    const Point2 p = away(i < anywhere ? room_m : kFarM);
    place.boxes.push_back(p);

    const grid::Cell low = grid.geometry().cell_at(p);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x)
        if (grid.geometry().contains({low.x + x, low.y + y}))
          grid.set({low.x + x, low.y + y}, grid::Occupancy::kOccupied);
  }

  // The tracks: anywhere, but not at the vehicle.
  place.clearance = grid::ClearanceField(grid, 5.0);

  for (int i = 0; i < tracks; ++i)
    place.movers.push_back({away(room_m + 0.4), {speed(random), speed(random)}, 0.25, 0.15, 0.2});

  return place;
}

/// 20 x 20 samples of 32 steps.
local_planner::DwaSettings bench_settings() {
  local_planner::DwaSettings settings;
  settings.horizon_s = 3.2;
  settings.linear_samples = 19;   // and the speed in force
  settings.angular_samples = 19;  // and straight on

  return settings;
}

/// Every critic with the same weight, so that each costs its full time.
local_planner::Variant all_critics() {
  using namespace local_planner;
  Variant variant = wang();

  variant.critics = {{heading_critic, .1},          {clearance_critic, .1},
                     {velocity_critic, .1},         {sub_target_heading_critic, .1},
                     {path_distance_critic, .1},    {sub_target_distance_critic, .1},
                     {static_clearance_critic, .1}, {dynamic_clearance_critic, .1}};

  return variant;
}

/// A way that bends a little to the left.
Aim make_aim(const Scene& scene) {
  const Point2 here = scene.base_in_map.position();
  Aim aim;

  aim.target_in_map = here + Point2{1.8, 0.2};
  aim.sub_target_in_map = here + Point2{0.6, 0.0};
  for (double s = 0.0; s < 3.0; s += 0.2) aim.path_in_map.push_back(here + Point2{s, 0.05 * s});

  return aim;
}

/// A line of the table, with all its measurements.
struct Row {
  VehicleKind vehicle;
  int boxes, anywhere, tracks;
  Place place;
  std::vector<double> ours, plain;  // ns a point
  std::vector<double> steady;       // ns of the loop beside
};

Row make_row(const VehicleKind& vehicle, int boxes, int anywhere, int tracks) {
  return {vehicle, boxes, anywhere, tracks, make_place(boxes, anywhere, tracks, vehicle.room_m), {}, {}, {}};
}

Row make_row(const VehicleKind& vehicle, int boxes, int tracks) { return make_row(vehicle, boxes, boxes, tracks); }

/// A loop that always costs the same, to see how steady the machine is: each multiplication waits for
/// the one before.
double time_steady_loop_ns() {
  volatile double kept = 1.0;

  const double begin = cpu_ns();
  double x = kept;

  for (int i = 0; i < 25000; ++i) x = x * 1.0000001 + 1e-9;
  kept = x;

  return cpu_ns() - begin;
}

/// The vehicle drives 0.6 m/s in the middle of the hall.
Scene make_scene(const Row& row) {
  static const std::vector<local_planner::PeerMotion> kNoPeers;
  kinematics::Limits limits;

  limits.model = row.vehicle.model;
  return {row.place.clearance,
          {0.5 * kHallM, 0.5 * kHallM, 0.0},
          {0.6, 0.1, 0.0},
          row.vehicle.discs.radius_m,
          limits,
          1.2,
          row.place.movers,
          kNoPeers,
          limits.model == kinematics::Model::kTricycle ? std::atan(limits.axle.wheelbase_m * 0.1 / 0.6) : 0.0,
          row.vehicle.discs.ahead_m};
}

/// kCycles cycles, with the steady loop after each.
void time_ours(Row& row) {
  const Scene scene = make_scene(row);
  const local_planner::Variant variant = all_critics();
  const Aim aim = make_aim(scene);

  volatile double kept = 0.0;

  for (int i = 0; i < kCycles; ++i) {
    const double begin = cpu_ns();
    kept = kept + choose(scene, aim, variant, bench_settings()).twist.linear_mps;
    row.ours.push_back((cpu_ns() - begin) / kPoints);
    row.steady.push_back(time_steady_loop_ns());
  }
}

/// Only the cycles of one row, without clocks.
void run_row(const Row& row, int cycles) {
  const Scene scene = make_scene(row);
  const local_planner::Variant variant = all_critics();
  const Aim aim = make_aim(scene);
  local_planner::Choice choice;

  for (int i = 0; i < cycles; ++i) choice = choose(scene, aim, variant, bench_settings());

  std::printf("%s, %d boxes, %d tracks: %a m/s, %a rad/s, walls %a m, tracks %a m, %d rejected\n", row.vehicle.name,
              row.boxes, row.tracks, choice.twist.linear_mps, choice.twist.angular_radps, choice.wall_gap_m,
              choice.mover_gap_m, choice.rejected_in_all());
}

/// As textbooks write it: every sample, every step, every disc, box and track, with libm.
double plain_cycle(const Place& place, const geometry::CoveringDiscs& discs) {
  double best = -1e18;
  double chosen = 0.0;
  const double box_m = discs.radius_m + 0.1, mover_m = discs.radius_m + 0.25;

  for (int iv = 0; iv < 20; ++iv)
    for (int iw = 0; iw < 20; ++iw) {
      const double v = 0.24 + 0.03 * iv;
      const double w = -0.65 + 0.075 * iw;
      double x = 0.5 * kHallM, y = 0.5 * kHallM, yaw = 0.0, gap = 1e9;

      for (int k = 1; k <= 32; ++k) {
        x += v * std::cos(yaw) * 0.1, y += v * std::sin(yaw) * 0.1, yaw += w * 0.1;

        for (const double ahead_m : discs.ahead_m) {
          const double disc_x = x + ahead_m * std::cos(yaw), disc_y = y + ahead_m * std::sin(yaw);
          for (const Point2 box : place.boxes) gap = std::min(gap, std::hypot(disc_x - box.x, disc_y - box.y) - box_m);

          for (const Mover& m : place.movers)
            gap = std::min(gap, std::hypot(disc_x - m.position_in_map.x - 0.1 * k * m.velocity_in_map.x,
                                           disc_y - m.position_in_map.y - 0.1 * k * m.velocity_in_map.y) -
                                    mover_m);
        }
      }

      const double score = gap < 0.0 ? -1e18
                                     : 0.2 * (3.14 - std::abs(std::atan2(10.2 - y, 11.8 - x) - yaw)) +
                                           0.5 * std::min(gap, 1.0) + 0.3 * v;
      if (score > best) best = score, chosen = v;
    }

  return chosen;
}

void time_plain(Row& row) {
  volatile double kept = 0.0;
  const double begin = cpu_ns();
  kept = kept + plain_cycle(row.place, row.vehicle.discs);
  row.plain.push_back((cpu_ns() - begin) / kPoints);
}

/// The value below which `share` of them lie.
double share_of(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double median_of(const std::vector<double>& values) { return share_of(values, 0.5); }

/// The median of each round: a machine that is slow for seconds is slow for all rows of a round.
std::vector<double> medians_by_round(const std::vector<double>& values) {
  std::vector<double> medians;
  for (std::size_t first = 0; first < values.size(); first += kCycles)
    medians.push_back(median_of({values.begin() + static_cast<std::ptrdiff_t>(first),
                                 values.begin() + static_cast<std::ptrdiff_t>(first + kCycles)}));

  return medians;
}

/// The median over the rounds of what one row took in a round to what another took in it.
double ratio_of(const std::vector<double>& row, const std::vector<double>& other) {
  std::vector<double> ratios = medians_by_round(row);
  const std::vector<double> others = medians_by_round(other);
  for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] /= others[i];
  return median_of(ratios);
}

/// p99 of single cycles, each to the median of its round.
double spread_of(std::vector<double> values) {
  const std::vector<double> medians = medians_by_round(values);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] /= medians[i / kCycles];
  return share_of(values, 0.99);
}

std::vector<Row> make_rows() {
  return {make_row(disc(), 0, 0),        make_row(disc(), 10, 0),           make_row(disc(), 100, 0),
          make_row(disc(), 500, 0),      make_row(disc(), 500, 10, 0),      make_row(disc(), 100, 10),
          make_row(disc(), 100, 50),     make_row(rectangle(), 10, 0),      make_row(rectangle(), 100, 0),
          make_row(rectangle(), 500, 0), make_row(rectangle(), 500, 10, 0), make_row(rectangle(), 100, 50),
          make_row(forklift(), 100, 0),  make_row(forklift(), 100, 50)};
}

void print_table(const std::vector<Row>& rows) {
  std::printf(
      "400 samples x 32 steps, eight critics; ns a trajectory point\n  %-10s %5s %6s %9s %7s %8s %8s %8s %8s %8s\n",
      "vehicle", "discs", "boxes", "anywhere", "tracks", "p10", "median", "p99", "plain", "ratio");

  for (const Row& row : rows) {
    const double ours = median_of(row.ours);
    const double plain = median_of(row.plain);

    std::printf("  %-10s %5zu %6d %9d %7d %8.2f %8.2f %8.2f %8.2f %8.3f\n", row.vehicle.name,
                row.vehicle.discs.ahead_m.size(), row.boxes, row.anywhere, row.tracks, share_of(row.ours, 0.1), ours,
                share_of(row.ours, 0.99), plain, ours / plain);
  }
}

/// One line: figure, goal, met or missed.
void goal(const std::string& what, double value, double most) {
  std::printf("  %-52s %6.2f, goal %.2f: %s\n", what.c_str(), value, most, value <= most ? "met" : "missed");
}

/// Ratios are taken round by round, so that a machine that is slow for a while does not count.
void print_goals(const std::vector<Row>& rows) {
  const auto row_of = [&](const std::string& vehicle, int boxes, int anywhere,
                          int tracks) -> const std::vector<double>& {
    return std::find_if(rows.begin(), rows.end(),
                        [&](const Row& row) {
                          return row.vehicle.name == vehicle && row.boxes == boxes && row.anywhere == anywhere &&
                                 row.tracks == tracks;
                        })
        ->ours;
  };

  const auto ours = [&](const std::string& vehicle, int boxes, int tracks) -> const std::vector<double>& {
    return row_of(vehicle, boxes, boxes, tracks);
  };

  for (const auto& [vehicle, most_ns] : {std::pair<std::string, double>{"disc", 10.0}, {"rectangle", 25.0}}) {
    goal(vehicle + ": ns a point, 100 boxes, median", median_of(ours(vehicle, 100, 0)), most_ns);
    goal(vehicle + ": 500 boxes to 10, anywhere", ratio_of(ours(vehicle, 500, 0), ours(vehicle, 10, 0)), 1.1);
    goal(vehicle + ": 500 boxes to 10, the same ten near", ratio_of(row_of(vehicle, 500, 10, 0), ours(vehicle, 10, 0)),
         1.1);
    goal(vehicle + ": 50 tracks to none", ratio_of(ours(vehicle, 100, 50), ours(vehicle, 100, 0)), 2.0);
  }

  goal("forklift: ns a point, 100 boxes, median", median_of(ours("forklift", 100, 0)), 25.0);

  // How much single cycles differ, beside a loop that should not.
  double worst = 0.0, worst_steady = 0.0, worst_of_both = 0.0;
  for (const Row& row : rows) {
    const double ours_spread = spread_of(row.ours), steady_spread = spread_of(row.steady);
    worst = std::max(worst, ours_spread), worst_steady = std::max(worst_steady, steady_spread);
    worst_of_both = std::max(worst_of_both, ours_spread / steady_spread);
  }

  goal("p99 of single cycles to their round's median, worst", worst, 2.0);
  std::printf("  %-52s %6.2f\n", "  the same of a loop that never changes", worst_steady);
  goal("  a row's cycles to the loop beside them, worst row", worst_of_both, 2.0);
}

/// The processor's name.
std::string machine() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown";
}

/// The figures of a row, with machine and compiler in front.
bool write_csv(const char* file, const std::vector<Row>& rows) {
  std::ofstream out(file);
  out << "# machine: " << machine() << ", " << std::thread::hardware_concurrency() << " threads\n# compiler: GCC "
      << __VERSION__ << "\n";
  out << "vehicle,discs,boxes,boxes_anywhere,tracks,samples,steps,cycles,ours_p10_ns_a_point,ours_ns_a_point,ours_p99_"
         "ns_a_point,plain_ns_a_point\n";

  for (const Row& row : rows)
    out << row.vehicle.name << ',' << row.vehicle.discs.ahead_m.size() << ',' << row.boxes << ',' << row.anywhere << ','
        << row.tracks << ",400,32," << row.ours.size() << ',' << share_of(row.ours, 0.1) << ',' << median_of(row.ours)
        << ',' << share_of(row.ours, 0.99) << ',' << median_of(row.plain) << '\n';

  return out.good();
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Row> rows = make_rows();
  if (argc == 4 && std::string_view(argv[1]) == "row") {
    const int row = std::atoi(argv[2]), cycles = std::atoi(argv[3]);
    if (row < 0 || row >= static_cast<int>(rows.size()) || cycles < 1) {
      std::fprintf(stderr, "dwa_cycle row N CYCLES: N from 0 to %zu, CYCLES from 1 on\n", rows.size() - 1);
      return 2;
    }

    run_row(rows[static_cast<std::size_t>(row)], cycles);
    return 0;
  }

  for (int round = 0; round < kRounds; ++round)
    for (Row& row : rows) {
      time_ours(row);
      if (round < 3) time_plain(row);  // it takes a hundred times as long
    }

  print_table(rows);
  print_goals(rows);

  return argc < 2 || write_csv(argv[1], rows) ? 0 : 3;
}
