#include "tools/aisle/tracking/tracking_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "common/config/reader.hpp"
#include "tools/aisle/planning/markdown.hpp"
#include "tools/tracking/picture.hpp"
#include "tools/tracking/trial.hpp"

namespace aisle::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;
using tracking::Row;
using tracking::Sensing;

constexpr std::uint64_t kSeed = 1;
constexpr double kDrawn_s = 60.0;

const std::vector<std::string>& recordings() {
  static const std::vector<std::string> all{"biwi_eth", "biwi_hotel", "crowds_zara01"};
  return all;
}

/// How far the truth's own velocity jumps where it changes (root mean square): no filter can know a jump before it shows.
class Jumps {
 public:
  void look(const tracking::Moment& truth) {
    for (const tracking::Walking& person : truth.people) {
      const auto [entry, is_new] = velocity_.try_emplace(person.id, person.velocity_in_map);
      const geometry::Point2 change = person.velocity_in_map - entry->second;
      const double change_mps = std::hypot(change.x, change.y);
      if (!is_new && change_mps > 1e-6) {
        sum_ += change_mps * change_mps;
        ++count_;
      }
      entry->second = person.velocity_in_map;
    }
  }
  double rms_mps() const { return count_ > 0 ? std::sqrt(sum_ / count_) : 0.0; }

 private:
  std::map<int, geometry::Point2> velocity_;
  double sum_{0.0};
  int count_{0};
};

std::vector<std::string> cells(const std::string& first, const Row& row, const std::string& jumps) {
  const tracking::Score& s = row.score;
  return {first,
          row.tracker,
          digits(s.mota, 3),
          digits(s.motp_m, 3),
          digits(s.idf1, 3),
          std::to_string(s.id_switches),
          std::to_string(s.fragments),
          digits(s.velocity_rms_mps, 2),
          jumps,
          digits(s.latency_scans, 2),
          digits(s.false_tracks_per_min, 2)};
}

std::vector<std::unique_ptr<tracking::Contestant>> both() {
  std::vector<std::unique_ptr<tracking::Contestant>> contestants;
  contestants.push_back(tracking::make_aisle());
  contestants.push_back(tracking::make_nearest_neighbour());
  return contestants;
}

void save(const std::filesystem::path& file, const std::string& svg) {
  std::ofstream out(file);
  out << svg;
  if (!out.flush()) throw config::BadEnvironment(file.string() + ": cannot be written; check the folder and its permissions");
}

std::string recorded_table(const TrackingExperiment& orders, const Progress& progress) {
  Rows table{{"people, two vehicles", "tracker", "MOTA", "MOTP m", "IDF1", "switches", "fragments", "velocity RMS m/s", "jumps of the truth m/s",
              "latency scans", "false tracks a minute"}};
  std::string pictures;
  for (const std::string& name : recordings()) {
    for (const bool drive : {false, true}) {
      const std::string title = name + (drive ? ", driving" : ", standing");
      progress("tracking: " + title);
      const auto scene = tracking::recorded_people(orders.people / (name + ".txt"), 2, drive);
      tracking::Picture picture(scene->walls(), 0, 0.0, kDrawn_s);
      Jumps jumps;
      const auto watch = [&](const tracking::Glance& now) {
        picture.look(now);
        jumps.look(now.truth);
      };
      for (const Row& row : tracking::run_trial(*scene, Sensing{}, kSeed, both(), orders.longest_s, watch)) {
        table.push_back(cells(title, row, digits(jumps.rms_mps(), 2)));
      }
      if (!drive) continue;
      const std::string file = "tracking-" + name + ".svg";
      save(orders.pictures / file, picture.svg());
      pictures += "![" + title + "](" + orders.pictures_from_page + "/" + file + ")\n\n";
    }
  }
  return markdown_table(table) +
         "The first minute among driving vehicles: everybody's true way in grey, the tracks in colours, the vehicles in black.\n\n" + pictures;
}

std::string fusion_table(const TrackingExperiment& orders, const Progress& progress) {
  Rows table{{"people, driving vehicles", "vehicles", "share of people's time seen", "MOTA", "MOTP m", "switches", "velocity RMS m/s"}};
  for (const std::string& name : recordings()) {
    for (const int vehicles : {1, 2, 4}) {
      progress("tracking: " + name + ", " + std::to_string(vehicles) + " vehicles");
      const auto scene = tracking::recorded_people(orders.people / (name + ".txt"), vehicles, true);
      const Row row = tracking::run_trial(*scene, Sensing{}, kSeed, both(), orders.longest_s).front();
      table.push_back({name, std::to_string(vehicles), digits(row.coverage, 3), digits(row.score.mota, 3), digits(row.score.motp_m, 3),
                       std::to_string(row.score.id_switches), digits(row.score.velocity_rms_mps, 2)});
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
    if (minutes <= 0.0) throw config::BadInput(orders.empty_place.string() + ": nobody drives in it; name a scenario with missions");
    const Row row = tracking::run_trial(*scene, sensing, seed, both()).front();
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
  for (const std::string& name : recordings()) {
    if (!std::filesystem::exists(orders.people / (name + ".txt"))) return false;
  }
  return true;
}

}  // namespace

std::string tracking_section(const TrackingExperiment& orders, const Progress& progress) {
  std::string text =
      "## Obstacle tracking\n\n"
      "Written by `aisle experiment tracking`: recorded people walk through an empty hall, lidars of 360 rays and 10 m turn ten times a second on disc vehicles "
      "of 0.35 m, pose noise 2 cm and 0.5 degrees, range noise 2 cm, each ray with the pose of its own moment. One set of parameters for all rows, the tracker's "
      "defaults. A person counts while a ray touched it within the last second. `nearest-neighbour` is the baseline: clusters, the nearest track within a "
      "gate, an alpha-beta filter for the velocity. Figures do not depend on the machine.\n\n";
  if (!has_recordings(orders)) return text + "Left out: the recordings are not there.\n\n";
  text += recorded_table(orders, progress);
  text +=
      "*Jumps of the truth*: the recordings give a place every 0.4 s, so that the true velocity is constant in between and jumps there by this much (root mean "
      "square); no tracker knows of a jump before it shows.\n\n"
      "### What several vehicles see\n\n" +
      fusion_table(orders, progress);
  text +=
      "### Ghosts\n\n"
      "`" + orders.empty_place.filename().string() +
      "` driven without its people and hidden blocks, seed after seed; every track is a ghost. Vehicles say in their scans how "
      "sure they are of their pose.\n\n" +
      ghost_table(orders, progress);
  return text;
}

}  // namespace aisle::cli
