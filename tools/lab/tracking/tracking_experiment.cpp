#include "tools/lab/tracking/tracking_experiment.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "common/config/reader.hpp"
#include "common/process/output_file.hpp"
#include "tools/lab/planning/markdown.hpp"
#include "tools/lab/tracking/detour_table.hpp"
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

const std::string kTruthNote =
    "*The truth.* The recordings give a place every 0.4 s, clicked into a film. People walk along the cubic B-spline "
    "of these places, in all recordings alike: at "
    "a row its velocity is the central difference. Straight lines in between, as people walk in the scenarios, jump in "
    "velocity at every row (root mean square "
    "0.47 m/s in biwi_eth, 0.25 in biwi_hotel, 0.11 in crowds_zara01), as nobody does, and in the first two one jump "
    "takes back the one before (correlation -0.25 "
    "and -0.40): errors of the clicks, not steps of the people. biwi_eth runs too fast: its people were marked every "
    "0.4 s, six frames of a film of 15 frames a second, and "
    "the file, in wide use, has a row every ten frames, read as 0.4 s too; so they hurry at 2.3 m/s on average, 1.0 "
    "and 1.1 in the others. *At 15 frames a "
    "second* plays it at their pace.\n\n";
const std::string kHonestyNote =
    "The same runs: squared errors over what the tracks' covariances say (normalised estimation error squared), of "
    "place and velocity, two degrees of freedom "
    "each. Honest is a mean of 2 and 0.95 within the 95 % bound; a larger mean is too sure. On people who move as the "
    "filter says it is within its bounds "
    "(`tests/unit/obstacle-tracker/filters_test.cpp`).\n\n";

/// A recording and how it is played.
struct Played {
  std::string name;
  double frames_per_s{tracking::kUsualFramesPerS};
  std::string remark{};
};

const std::vector<Played>& recordings() {
  static const std::vector<Played> all{
      {"biwi_eth"}, {"biwi_eth", 15.0, " at 15 frames a second"}, {"biwi_hotel"}, {"crowds_zara01"}};
  return all;
}

std::string usual() { return obstacle_tracker::MotionModel{}.filter; }

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

/// The trackers on every recording, and how honest they are.
std::string recorded_tables(const TrackingExperiment& orders, const Progress& progress) {
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
  return markdown_table(table) +
         "The first minute among driving vehicles: everybody's true way in grey, the tracks in colours, the vehicles "
         "in black.\n\n" +
         pictures + kTruthNote + "### As sure as it may be\n\n" + kHonestyNote + markdown_table(honesty);
}

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
      throw config::BadInput(orders.empty_place.string() + ": nobody drives in it; name a scenario with missions");
    const Row row = tracking::run_trial(*scene, sensing, seed, contestants(false)).front();
    sum.begun += row.score.false_tracks_per_min * minutes;
    sum.longest_s = std::max(sum.longest_s, row.score.longest_false_s);
    sum.minutes += minutes;
  }
  return sum;
}

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

bool has_recordings(const TrackingExperiment& orders) {
  for (const Played& played : recordings()) {
    if (!std::filesystem::exists(orders.people / (played.name + ".txt"))) return false;
  }
  return true;
}

}  // namespace

std::string tracking_section(const TrackingExperiment& orders, const Progress& progress) {
  std::string text =
      "## Obstacle tracking\n\n"
      "Written by `aisle experiment tracking`: recorded people walk through an empty hall, lidars of 360 rays and 10 m "
      "turn ten times a second on disc vehicles "
      "of 0.35 m, pose noise 2 cm and 0.5 degrees, range noise 2 cm, each ray with the pose of its own moment. One set "
      "of parameters for all rows, the tracker's "
      "defaults; trackers are named after their filter, the first is the default. A person counts while a ray touched "
      "it within the last second. `nearest-neighbour` is the baseline: clusters, the nearest track within a "
      "gate, an alpha-beta filter for the velocity. Figures do not depend on the machine.\n\n";
  if (!has_recordings(orders)) return text + "Left out: the recordings are not there.\n\n";
  text += recorded_tables(orders, progress);
  text += "### What several vehicles see\n\n" + fusion_table(orders, progress);
  text +=
      "### Ghosts\n\n"
      "`" +
      orders.empty_place.filename().string() +
      "` driven without its people and hidden blocks, seed after seed; every track is a ghost. Vehicles say in their "
      "scans how "
      "sure they are of their pose.\n\n" +
      ghost_table(orders, progress);
  if (orders.detour_seeds <= 0) return text;
  return text +
         "### What prediction is worth\n\n"
         "Drives of the suite in lock-step (see local planning, `wang`), " +
         std::to_string(orders.detour_seeds) +
         " seeds of each family, once with the tracks as they are and once with every track held still where it is: "
         "the planners see the same people, but not "
         "where they go. Length and time are means of a drive; *beyond the plan* is the way driven less the first "
         "plan's.\n\n" +
         detour_table(orders.detour_seeds, progress);
}

}  // namespace aisle::lab
