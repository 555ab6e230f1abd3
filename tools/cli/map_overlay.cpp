// aisle map overlay, aisle map accept: what stands on the site that the map does not show, and a person's word that it
// is of the map.

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/topics.hpp"
#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/service/hear.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/edit_talk.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

constexpr int kListen_s = 2;  // a standing track is said twice a second

/// A track, and which tracker it is from.
struct SaidTrack {
  fleet::Track track;
  fleet::Origin by;
};

/// Listens to the tracker: the newest sample of each live track, moving ones too.
class TrackBook {
 public:
  explicit TrackBook(bus::Bus& bus) {
    service::hear<topics::Track>(bus, {[this](const fleet::Track& track, const service::Sender& from) {
                                         tracks_[track.id] = {track, from.by};
                                       },
                                       [this](std::uint64_t id, service::End) { tracks_.erase(id); },
                                       {}});

    service::hear<topics::TrackingStatus>(
        bus, {[this](const fleet::TrackingStatus&, const service::Sender&) { has_tracker_ = true; }, {}, {}});
  }

  /// Was a tracker heard, even without a track?
  bool has_tracker() const { return has_tracker_ || !tracks_.empty(); }

  /// Null when there is no such track.
  const fleet::Track* find(std::uint64_t id) const {
    const auto found = tracks_.find(id);
    return found == tracks_.end() ? nullptr : &found->second.track;
  }

  /// Only those that stand.
  std::vector<SaidTrack> standing() const {
    std::vector<SaidTrack> standing;
    for (const auto& [id, said] : tracks_) {
      if (said.track.is_static) standing.push_back(said);
    }

    return standing;
  }

 private:
  std::map<std::uint64_t, SaidTrack> tracks_;
  bool has_tracker_{false};
};

/// @throws config::BadEnvironment when none was heard
void require_tracker(const Cli& cli, const TrackBook& book) {
  if (book.has_tracker()) return;
  throw config::BadEnvironment("no obstacle tracker heard in " + place_of(cli.settings) +
                               "; is aisle-obstacle-tracker running, and does a vehicle scan?");
}

/// Waits for a tracker, then listens a while, then shows what stands.
int show_overlay(const Cli& cli, double wait_s) {
  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-map-overlay");
  TrackBook book(*bus);

  run_until(*bus, Seconds(wait_s), [&] { return book.has_tracker(); });
  require_tracker(cli, book);

  // Long enough for every standing track to be said.
  run_until(*bus, Seconds(kListen_s), [] { return false; });

  Json json = Json::array();
  std::vector<std::vector<std::string>> rows{{"TRACK", "X_M", "Y_M", "RADIUS_M", "KNOWN_FOR_S", "UNSEEN_S"}};

  for (const auto& [track, by] : book.standing()) {
    json.push_back(json_of(track, by));
    rows.push_back({std::to_string(track.id), fmt::format("{:.2f}", track.position_in_map.x),
                    fmt::format("{:.2f}", track.position_in_map.y), fmt::format("{:.2f}", track.radius_m),
                    fmt::format("{:.0f}", track.age_s), fmt::format("{:.0f}", track.unseen_s)});
  }

  if (cli.json)
    std::printf("%s\n", write_json(json).c_str());
  else if (json.empty())
    std::printf("nothing stands that the map does not show\n");
  else
    std::printf("%s", text_of_table(rows).c_str());

  return process::kDone;
}

/// @throws config::BadInput when it is not a number
std::uint64_t track_id_of(const std::string& text) {
  const bool is_number = !text.empty() && text.size() < 20 && text.find_first_not_of("0123456789") == std::string::npos;
  if (!is_number)
    throw config::BadInput("'" + text + "' is not the id of a track, a number; aisle map overlay lists them");
  return std::stoull(text);
}

/// Blocks the disc that the track covers. The edit is named after the track: however often it is
/// accepted, it is applied once.
fleet::MapEdit edit_from(const fleet::Track& track) {
  fleet::MapEdit edit;
  edit.edit_id = "track-" + std::to_string(track.id);
  edit.action = fleet::MapEdit::Action::kBlock;
  edit.shape = fleet::MapEdit::Shape::kDisc;
  edit.points_in_map = {track.position_in_map};
  edit.radius_m = track.radius_m;

  return edit;
}

/// Prints why and returns the exit code.
int refuse(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  return process::kNegative;
}

struct AcceptOptions {
  std::string track;
  std::string map_id;
  double timeout_s{5.0};
};

/// Makes a standing track part of the map.
int accept_track(const Cli& cli, const AcceptOptions& options) {
  const std::uint64_t id = track_id_of(options.track);
  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-map-accept");
  TrackBook book(*bus);

  run_until(*bus, Seconds(options.timeout_s), [&] { return book.find(id) != nullptr; });
  require_tracker(cli, book);

  const fleet::Track* track = book.find(id);
  if (track == nullptr) return refuse(fmt::format("no track {} is there; aisle map overlay lists what stands", id));
  if (!track->is_static)
    return refuse(fmt::format("track {} has not stood for 3 s: only what stands becomes part of the map", id));

  return print_result(cli, EditTalk(*bus).apply(edit_from(*track), options.map_id, options.timeout_s));
}

}  // namespace

void add_map_overlay(CLI::App& parent, Cli& cli) {
  auto wait_s = std::make_shared<double>(3.0);
  Verb(parent, cli, "overlay", "what stands on the site that the map does not show; the global planner goes around it")
      .option("--wait", *wait_s, 0.1, 1e6, "seconds to wait for an obstacle tracker")
      .runs([&cli, wait_s] { return show_overlay(cli, *wait_s); });
}

void add_map_accept(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<AcceptOptions>();
  Verb(parent, cli, "accept",
       "block in the map what a standing track covers; exit code 1 when it moves, is gone, or is refused")
      .argument("TRACK", options->track, "id of the track, from aisle map overlay")
      .option("--map", options->map_id, "id of the map; the one that is seen when not given")
      .option("--timeout", options->timeout_s, 0.1, 1e6, "give up after so many seconds")
      .runs([&cli, options] { return accept_track(cli, *options); });
}

}  // namespace aisle::cli
