// aisle track: the tracker's core and a baseline on simulated scans of recorded or scripted people, judged against the
// truth.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/output_file.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/json.hpp"
#include "tools/lab/tracking/picture.hpp"
#include "tools/lab/tracking/trial.hpp"

namespace aisle::cli {
namespace {

/// The flags with their defaults.
struct Options {
  std::string pedestrians;
  std::string scenario;
  std::string svg;
  std::string tracker{obstacle_tracker::MotionModel{}.filter};
  int vehicles{0};
  int seed{1};
  bool drive{false};
  bool empty{false};
  double seconds{3600.0};
  double frames_per_s{tracking::kUsualFramesPerS};
  tracking::Sensing sensing;
  double yaw_noise_deg{0.5};
};

constexpr int kUsualVehicles = 2;
constexpr double kDrawn_s = 60.0;
const std::string kAll = "all";

/// Recorded people, or a driven scenario. @throws config::BadInput for flags that do not go together
std::unique_ptr<tracking::Scene> scene_of(const Options& options) {
  if (options.pedestrians.empty() == options.scenario.empty()) {
    throw config::BadInput("either --pedestrians FILE (rows of 'frame id x y') or --scenario FILE is needed");
  }

  if (!options.scenario.empty()) {
    if (options.drive) throw config::BadInput("--drive is for --pedestrians: a scenario's vehicles drive anyway");
    return tracking::driven_scenario(options.scenario, options.vehicles, static_cast<std::uint64_t>(options.seed),
                                     options.empty ? tracking::Cast::kVehiclesOnly : tracking::Cast::kAll);
  }

  if (options.empty)
    throw config::BadInput("--empty is for --scenario: recorded people are all there is to see in --pedestrians");

  return tracking::recorded_people(options.pedestrians, options.vehicles > 0 ? options.vehicles : kUsualVehicles,
                                   options.drive, options.frames_per_s);
}

Json json_of(const tracking::Row& row) {
  const tracking::Score& score = row.score;
  return Json{{"tracker", row.tracker},
              {"mota", score.mota},
              {"motp_m", score.motp_m},
              {"idf1", score.idf1},
              {"id_switches", score.id_switches},
              {"fragments", score.fragments},
              {"speed_rms_mps", score.velocity_rms_mps},
              {"coverage", row.coverage},
              {"false_tracks_per_min", score.false_tracks_per_min},
              {"scan_ms_p50", row.scan_ms_p50},
              {"scan_ms_p99", row.scan_ms_p99}};
}

/// One JSON array, or a table.
void print(const Cli& cli, const std::vector<tracking::Row>& rows) {
  if (cli.json) {
    Json all = Json::array();
    for (const tracking::Row& row : rows) all.push_back(json_of(row));
    std::printf("%s\n", write_json(all).c_str());
    return;
  }

  std::printf("%-18s %6s %7s %6s %9s %10s %10s %9s %9s %11s %11s %11s\n", "tracker", "MOTA", "MOTP m", "IDF1",
              "switches", "fragments", "speed m/s", "latency", "coverage", "false/min", "scan ms p50", "scan ms p99");

  for (const tracking::Row& row : rows) {
    const tracking::Score& score = row.score;
    std::printf("%-18s %6.3f %7.3f %6.3f %9d %10d %10.3f %9.2f %9.3f %11.2f %11.3f %11.3f\n", row.tracker.c_str(),
                score.mota, score.motp_m, score.idf1, score.id_switches, score.fragments, score.velocity_rms_mps,
                score.latency_scans, row.coverage, score.false_tracks_per_min, row.scan_ms_p50, row.scan_ms_p99);
  }
}

/// One tracker, or every variant of it; and the baseline.
std::vector<std::unique_ptr<tracking::Contestant>> contestants_of(const std::string& name) {
  std::vector<std::unique_ptr<tracking::Contestant>> contestants;
  for (const obstacle_tracker::Filter& filter : obstacle_tracker::all_filters()) {
    if (name == kAll || name == filter.name) contestants.push_back(tracking::make_aisle(filter.name));
  }

  if (contestants.empty()) {
    throw config::BadInput("--tracker: '" + name + "' is unknown; there are " + obstacle_tracker::filter_names() +
                           ", and " + kAll);
  }

  contestants.push_back(tracking::make_nearest_neighbour());
  return contestants;
}

/// Simulates the scans, runs all contestants on them and prints their scores.
int track(const Cli& cli, const Options& options) {
  if (!options.svg.empty()) process::check_writable(options.svg);

  const std::unique_ptr<tracking::Scene> scene = scene_of(options);
  const std::vector<std::unique_ptr<tracking::Contestant>> contestants = contestants_of(options.tracker);
  tracking::Sensing sensing = options.sensing;

  sensing.yaw_noise_rad = options.yaw_noise_deg * geometry::kPi / 180.0;

  tracking::Picture picture(scene->walls(), 0, 0.0, kDrawn_s);

  const std::vector<tracking::Row> rows =
      tracking::run_trial(*scene, sensing, static_cast<std::uint64_t>(options.seed), contestants, options.seconds,
                          [&](const tracking::Glance& now) { picture.look(now); });

  if (!options.svg.empty()) process::write_output_file(options.svg, picture.svg());

  print(cli, rows);

  return process::kDone;
}

}  // namespace

void add_track(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<Options>();
  Verb(parent, cli, "track", "the tracker and a baseline on simulated scans, without DDS, judged against the truth")
      .option("--pedestrians", options->pedestrians, "recorded people: rows of 'frame id x y'")
      .option("--frames-per-second", options->frames_per_s, 0.1, 1000.0, "of that recording")
      .option("--scenario", options->scenario, "a scenario file, driven on the simulated site")
      .option("--tracker", options->tracker,
              "by its filter: " + obstacle_tracker::filter_names() + ", or all in the same run")
      .option("--vehicles", options->vehicles, 0, 64,
              "how many have eyes (0: all of a scenario, two among recorded people)")
      .flag("--drive", options->drive, "the vehicles among recorded people drive, not stand")
      .flag("--empty", options->empty, "the scenario without its people and hidden blocks: every track is a ghost")
      .option("--seed", options->seed, 0, 1'000'000'000, "of the noise")
      .option("--seconds", options->seconds, 1.0, 1e6, "at most")
      .option("--pose-noise", options->sensing.pose_noise_m, 0.0, 1.0,
              "m, standard deviation of a vehicle's position, each axis")
      .option("--yaw-noise", options->yaw_noise_deg, 0.0, 30.0, "degrees, of its heading")
      .option("--range-noise", options->sensing.range_noise_m, 0.0, 1.0, "m, of a range")
      .option("--svg", options->svg, "file for a picture of the first minute")
      .runs([&cli, options] { return track(cli, *options); });
}

}  // namespace aisle::cli
