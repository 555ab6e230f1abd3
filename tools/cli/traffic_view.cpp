#include "tools/cli/traffic_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/bus/topics.hpp"
#include "common/service/hear.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

/// Beyond this share of the roadmap's places the fleet's throughput falls behind.
constexpr double kSaturatedShare = 0.10;

/// A vehicle with a goal that stands and says why.
bool stands_with_goal(const fleet::NavigationStatus& status) {
  const bool stands = status.phase == fleet::Phase::kWaiting || status.phase == fleet::Phase::kBlocked ||
                      status.phase == fleet::Phase::kHeld;
  return stands && !status.goal_id.empty();
}

}  // namespace

/// An epoch only grows, so an older one is a planner that does not know yet that it was replaced.
void LeadersWord::take(const fleet::TrafficStatus& status, const fleet::Origin& by, time::Stamp now) {
  if (status_ && by.epoch < by_.epoch) return;

  status_ = status;
  by_ = by;
  arrived_ = now;
}

void LeadersWord::lose(const std::string& source_id) {
  if (status_ && status_->source_id == source_id) status_.reset();
}

const fleet::WaitingVehicle* LeadersWord::find_waiting(const std::string& agv_id) const {
  if (!status_) return nullptr;

  const auto found = std::find_if(status_->waiting.begin(), status_->waiting.end(),
                                  [&](const fleet::WaitingVehicle& waiting) { return waiting.agv_id == agv_id; });
  return found == status_->waiting.end() ? nullptr : &*found;
}

/// One reader for each kind of value.
void TrafficView::watch(bus::Bus& bus) {
  using service::End;
  using service::hear;
  using service::Sender;

  hear<topics::TrafficStatus>(
      bus, {[this](const fleet::TrafficStatus& status, const Sender& from) { take(status, from.by, from.arrived); },
            [this](const std::string& source_id, End) { lose_planner(source_id); },
            {}});

  hear<topics::Grant>(bus, {[this](const fleet::Grant& grant, const Sender&) { take(grant); }, {}, {}});
  hear<topics::Plan>(bus, {[this](const fleet::Plan& plan, const Sender&) { take(plan); }, {}, {}});

  hear<topics::NavigationStatus>(bus, {[this](const fleet::NavigationStatus& status, const Sender&) { take(status); },
                                       [this](const std::string& agv_id, End) { lose_navigation(agv_id); },
                                       {}});

  hear<topics::VehicleState>(bus, {[this](const fleet::VehicleState& state, const Sender&) { take(state); }, {}, {}});
  hear<topics::VehicleInfo>(bus, {[this](const fleet::Vehicle& vehicle, const Sender&) { take(vehicle); }, {}, {}});
}

/// The leader's word first. A vehicle that stands without being named there tells itself why; only the leader knows
/// since when.
Json TrafficView::waiting(const std::string& agv_id, const VehicleEntry& vehicle) const {
  const fleet::WaitingVehicle* const said = leader_.find_waiting(agv_id);
  const fleet::NavigationStatus* const navigation = vehicle.navigation ? &*vehicle.navigation : nullptr;
  if (said == nullptr && (navigation == nullptr || !stands_with_goal(*navigation))) return nullptr;

  Json row{{"agv_id", agv_id}};

  if (said != nullptr) {
    row["waits_for"] = said->waits_for;
    row["since_s"] = said->since_s;
    row["why"] = said->reason;
  } else {
    const bool is_named = vehicle.grant && !vehicle.grant->waits_for.empty();
    row["waits_for"] = is_named ? vehicle.grant->waits_for.front() : "";
    row["why"] = navigation->detail;
  }

  if (navigation != nullptr) {
    row["phase"] = word_of(name(navigation->phase));
    row["reason"] = word_of(name(navigation->reason));
    row["goal_id"] = navigation->goal_id;
  }

  return row;
}

Json TrafficView::snapshot(time::Stamp now) const {
  const fleet::TrafficStatus& status = leader_.status();

  // A vehicle that only the leader knows of is told too.
  std::map<std::string, VehicleEntry> vehicles = vehicles_;
  for (const fleet::WaitingVehicle& waiting : status.waiting) vehicles.try_emplace(waiting.agv_id);

  Json waits = Json::array();
  for (const auto& [id, vehicle] : vehicles) {
    Json row = waiting(id, vehicle);
    if (!row.is_null()) waits.push_back(std::move(row));
  }

  Json silent = Json::array(), signed_off = Json::array();
  const auto row_of = [](const fleet::SilentVehicle& vehicle) {
    return Json{{"agv_id", vehicle.agv_id}, {"place_in_map", to_json(wire::encode(vehicle.place_in_map))}};
  };
  for (const fleet::SilentVehicle& vehicle : status.silent) silent.push_back(row_of(vehicle));
  for (const fleet::SilentVehicle& vehicle : status.signed_off) signed_off.push_back(row_of(vehicle));

  return Json{{"leader",
               {{"source_id", status.source_id},
                {"epoch", leader_.by().epoch},
                {"beat", status.beat},
                {"silent_s", time::seconds(now - leader_.arrived())}}},
              {"vehicles", status.vehicles},
              {"with_goal", status.with_goal},
              {"share_of_places", status.share_of_places},
              {"saturated", status.share_of_places > kSaturatedShare},
              {"slice_ms_p99", status.slice_ms_p99},
              {"refused", status.refused},
              {"circles", status.circles},
              {"register_version", status.register_version},
              {"waiting", std::move(waits)},
              {"silent", std::move(silent)},
              {"signed_off", std::move(signed_off)}};
}

/// Lengths along a plan count only for the plan that they were said of.
std::vector<DrawnVehicle> TrafficView::drawn() const {
  std::vector<DrawnVehicle> drawn;
  for (const auto& [id, vehicle] : vehicles_) {
    if (!vehicle.state) continue;

    DrawnVehicle one;
    one.agv_id = id;
    one.base_in_map = vehicle.state->motion.base_in_map;
    if (vehicle.kind) one.footprint = vehicle.kind->footprint;

    if (vehicle.plan && vehicle.plan->is_found()) {
      one.way_in_map = vehicle.plan->waypoints_in_map;
      const bool is_driven = vehicle.navigation && vehicle.navigation->plan_id == vehicle.plan->id;
      const bool is_granted = vehicle.grant && vehicle.grant->plan_id == vehicle.plan->id;
      if (is_driven) one.driven_m = vehicle.navigation->progress_m;
      one.granted_m = is_granted ? vehicle.grant->limit_m : is_driven ? vehicle.navigation->limit_m : 0.0;
    }

    const Json row = waiting(id, vehicle);
    if (!row.is_null()) one.waits_for = row["waits_for"];
    drawn.push_back(std::move(one));
  }

  return drawn;
}

/// From the JSON, so that both outputs say the same.
std::string text_of_traffic(const Json& snapshot) {
  const Json& leader = snapshot["leader"];
  std::string text = fmt::format(
      "leader {}, epoch {}, heard {:.1f} s ago\n"
      "{} vehicles, {} with a goal; {:.1f} % of the places taken{}; planning {:.1f} ms a turn (99 %); {} refused, {} "
      "circles\n",
      printable(leader["source_id"]), leader["epoch"].get<std::uint32_t>(), leader["silent_s"].get<double>(),
      snapshot["vehicles"].get<std::uint32_t>(), snapshot["with_goal"].get<std::uint32_t>(),
      100.0 * snapshot["share_of_places"].get<double>(), snapshot["saturated"].get<bool>() ? " (saturated)" : "",
      snapshot["slice_ms_p99"].get<double>(), snapshot["refused"].get<std::uint64_t>(),
      snapshot["circles"].get<std::uint64_t>());

  // The reason is text of any length, so it comes last.
  std::vector<std::vector<std::string>> waiting{{"VEHICLE", "WAITS FOR", "SINCE s", "PHASE", "REASON", "WHY"}};
  for (const Json& row : snapshot["waiting"]) {
    waiting.push_back({row["agv_id"], word(row, "waits_for"),
                       row.contains("since_s") ? fmt::format("{:.1f}", row["since_s"].get<double>()) : "-",
                       word(row, "phase"), word(row, "reason"), word(row, "why")});
  }

  const auto places = [](const Json& vehicles, const char* title) {
    std::vector<std::vector<std::string>> rows{{title, "X m", "Y m"}};
    for (const Json& row : vehicles) {
      const Json& place = row["place_in_map"];
      rows.push_back({row["agv_id"], fmt::format("{:.2f}", place["x_m"].get<double>()),
                      fmt::format("{:.2f}", place["y_m"].get<double>())});
    }
    return rows;
  };
  const std::vector<std::vector<std::string>> silent = places(snapshot["silent"], "SILENT");
  const std::vector<std::vector<std::string>> signed_off = places(snapshot["signed_off"], "SIGNED OFF");

  text += "\n" + (waiting.size() > 1 ? text_of_table(waiting) : "no vehicle waits\n");
  if (silent.size() > 1) text += "\n" + text_of_table(silent);
  if (signed_off.size() > 1) text += "\n" + text_of_table(signed_off);

  return text;
}

}  // namespace aisle::cli
