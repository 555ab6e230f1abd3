#include "tools/lab/tracking/tracking_experiment.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "common/config/reader.hpp"
#include "common/process/output_file.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/lab/page/templates.hpp"
#include "tools/lab/tracking/detour_table.hpp"
#include "tools/lab/tracking/jumps.hpp"
#include "tools/lab/tracking/picture.hpp"
#include "tools/lab/tracking/trial.hpp"

namespace aisle::lab {
namespace {

using Rows = std::vector<std::vector<std::string>>;
using tracking::Row;
using tracking::Sensing;

constexpr std::uint64_t kSeed = 1;
constexpr double kDrawn_s = 60.0;
const std::string kBaseline = "nearest-neighbour";

/// A recording and how it is played.
struct Played {
  std::string name;
  double frames_per_s{tracking::kUsualFramesPerS};
  std::string remark{};
};

/// One of them at two paces.
const std::vector<Played>& recordings() {
  static const std::vector<Played> all{
      {"biwi_eth"}, {"biwi_eth", 15.0, " at 15 frames a second"}, {"biwi_hotel"}, {"crowds_zara01"}};
  return all;
}

/// The filter that the service uses by default.
std::string usual() { return obstacle_tracker::MotionModel{}.filter; }

/// The scores of one tracker.
std::vector<std::string> cells(const std::string& first, const Row& row) {
  const tracking::Score& s = row.score;
  return {first,
          row.tracker,
          digits(s.mota, 3),
          digits(s.motp_m, 3),
          digits(s.idf1, 3),
          std::to_string(s.id_switches),
          std::to_string(s.fragments),
          digits(s.velocity_rms_mps, 2),
          digits(s.latency_scans, 2),
          digits(s.false_tracks_per_min, 2)};
}

/// How sure it says to be, against its errors.
std::vector<std::string> honesty_cells(const std::string& first, const Row& row) {
  const tracking::Score& s = row.score;
  return {first,
          row.tracker,
          digits(s.place.mean, 2),
          digits(s.place.inside, 3),
          digits(s.velocity.mean, 2),
          digits(s.velocity.inside, 3)};
}

/// Every filter, or the usual one, and the baseline.
std::vector<std::unique_ptr<tracking::Contestant>> contestants(bool all) {
  std::vector<std::unique_ptr<tracking::Contestant>> contestants;
  contestants.push_back(tracking::make_aisle(usual()));

  for (const obstacle_tracker::Filter& filter : obstacle_tracker::all_filters()) {
    if (all && filter.name != usual()) contestants.push_back(tracking::make_aisle(filter.name));
  }

  contestants.push_back(tracking::make_nearest_neighbour());
  return contestants;
}

/// The trackers on every recording.
struct Recorded {
  std::string scores;
  std::string honesty;   // errors over what the covariances say
  std::string pictures;  // links
};

/// Two vehicles among the people of each recording, standing and driving.
Recorded recorded_tables(const TrackingExperiment& orders, const Progress& progress) {
  Rows table{{"people, two vehicles", "tracker", "MOTA", "MOTP m", "IDF1", "switches", "fragments", "velocity RMS m/s",
              "latency scans", "false tracks a minute"}};
  Rows honesty{{"people, two vehicles", "tracker", "place: mean", "within 95 %", "velocity: mean", "within 95 %"}};
  std::string pictures;

  for (const Played& played : recordings()) {
    for (const bool drive : {false, true}) {
      const std::string title = played.name + played.remark + (drive ? ", driving" : ", standing");
      progress("tracking: " + title);

      const auto scene =
          tracking::recorded_people(orders.people / (played.name + ".txt"), 2, drive, played.frames_per_s);
      tracking::Picture picture(scene->walls(), 0, 0.0, kDrawn_s);
      const auto watch = [&](const tracking::Glance& now) { picture.look(now); };

      for (const Row& row : tracking::run_trial(*scene, Sensing{}, kSeed, contestants(true), orders.longest_s, watch)) {
        table.push_back(cells(title, row));
        if (row.tracker != kBaseline) honesty.push_back(honesty_cells(title, row));
      }

      if (!drive || !played.remark.empty()) continue;

      const std::string file = "tracking-" + played.name + ".svg";
      process::write_output_file(orders.pictures / file, picture.svg());
      pictures += "![" + title + "](" + orders.pictures_from_page + "/" + file + ")\n\n";
    }
  }

  return {markdown_table(table), markdown_table(honesty), pictures};
}

/// What the recordings themselves are like.
std::string recordings_table(const TrackingExperiment& orders) {
  Rows table{{"recording", "speed m/s", "jump of velocity at a row, RMS m/s", "correlation with the jump before"}};
  for (const Played& played : recordings()) {
    if (!played.remark.empty()) continue;
    const tracking::Jumps jumps = tracking::jumps_of(orders.people / (played.name + ".txt"));
    table.push_back(
        {played.name, digits(jumps.mean_speed_mps, 1), digits(jumps.rms_mps, 2), digits(jumps.correlation, 2)});
  }

  return markdown_table(table);
}

/// The usual tracker with one, two and four vehicles.
std::string fusion_table(const TrackingExperiment& orders, const Progress& progress) {
  Rows table{{"people, driving vehicles", "vehicles", "share of people's time seen", "MOTA", "MOTP m", "switches",
              "velocity RMS m/s"}};
  for (const Played& played : recordings()) {
    if (!played.remark.empty()) continue;

    const std::string& name = played.name;
    for (const int vehicles : {1, 2, 4}) {
      progress("tracking: " + name + ", " + std::to_string(vehicles) + " vehicles");

      const auto scene = tracking::recorded_people(orders.people / (name + ".txt"), vehicles, true);
      const Row row = tracking::run_trial(*scene, Sensing{}, kSeed, contestants(false), orders.longest_s).front();

      table.push_back({name, std::to_string(vehicles), digits(row.coverage, 3), digits(row.score.mota, 3),
                       digits(row.score.motp_m, 3), std::to_string(row.score.id_switches),
                       digits(row.score.velocity_rms_mps, 2)});
    }
  }

  return markdown_table(table);
}

/// Tracks in a place without people.
struct Ghosts {
  double begun{0.0};
  double longest_s{0.0};
  double minutes{0.0};
};

/// Seed by seed until the time has passed.
Ghosts ghosts(const TrackingExperiment& orders, const Sensing& sensing) {
  Ghosts sum;
  for (std::uint64_t seed = 1; sum.minutes * 60.0 < orders.empty_s; ++seed) {
    const auto scene = tracking::driven_scenario(orders.empty_place, 0, seed, tracking::Cast::kVehiclesOnly);
    const double minutes = scene->duration_s() / 60.0;
    if (minutes <= 0.0)
      throw config::BadInput(orders.empty_place.string() + ": no vehicle drives in it; name a scenario with missions");

    const Row row = tracking::run_trial(*scene, sensing, seed, contestants(false)).front();
    sum.begun += row.score.false_tracks_per_min * minutes;
    sum.longest_s = std::max(sum.longest_s, row.score.longest_false_s);
    sum.minutes += minutes;
  }

  return sum;
}

/// With the usual error of localisation, and with more.
std::string ghost_table(const TrackingExperiment& orders, const Progress& progress) {
  Rows table{{"pose noise", "minutes", "false tracks a minute", "longest s"}};
  const std::vector<std::pair<std::string, Sensing>> cases{{"2 cm, 0.5 degrees", {}},
                                                           {"5 cm, 1 degree", {0.02, 0.05, geometry::kPi / 180.0}}};

  for (const auto& [title, sensing] : cases) {
    progress("tracking: empty place, " + title);
    const Ghosts sum = ghosts(orders, sensing);
    table.push_back({title, digits(sum.minutes, 1), digits(sum.begun / sum.minutes, 2), digits(sum.longest_s, 1)});
  }

  return markdown_table(table);
}

/// Are all of them there?
bool has_recordings(const TrackingExperiment& orders) {
  for (const Played& played : recordings()) {
    if (!std::filesystem::exists(orders.people / (played.name + ".txt"))) return false;
  }

  return true;
}

}  // namespace

/// Without the recordings the section says only that they are missing.
FilledPage tracking_section(const TrackingExperiment& orders, const Progress& progress) {
  Texts texts{{"recorded", ""}, {"commit", orders.commit}};
  if (!has_recordings(orders)) return fill(kObstacleTrackingTemplate, texts);

  const Recorded recorded = recorded_tables(orders, progress);
  texts["recorded"] = recorded.scores;
  texts["honesty"] = recorded.honesty;
  texts["pictures"] = recorded.pictures;
  texts["recordings"] = recordings_table(orders);
  texts["fleets"] = fusion_table(orders, progress);
  texts["empty_place"] = orders.empty_place.filename().string();
  texts["ghosts"] = ghost_table(orders, progress);
  texts["detour_seeds"] = std::to_string(orders.detour_seeds);
  texts["detours"] = orders.detour_seeds > 0 ? detour_table(orders.detour_seeds, progress) : "";

  return fill(kObstacleTrackingTemplate, texts);
}

}  // namespace aisle::lab
