#include "tools/cli/goal_talk.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"
#include "common/fleet/any_vehicle.hpp"
#include "common/service/hear.hpp"

namespace aisle::cli {
namespace {

constexpr Seconds kUntilVehiclesAreSeen{3.0};
constexpr std::chrono::milliseconds kSayAgainAfter{500};

}  // namespace

/// Hears everything that says how a goal fares.
GoalTalk::GoalTalk(const Cli& cli, const std::string& agv_id)
    : cli_(cli),
      agv_id_(agv_id),
      is_for_any_(agv_id == fleet::kAnyVehicle),
      bus_(join(cli, "aisle-goal")),
      writer_(bus_->writer<topics::Goal>()),
      stamper_(*bus_, "aisle", static_cast<std::uint64_t>(bus_->wall_clock_ns()) / 1000) {
  using service::Sender;
  service::hear<topics::VehicleInfo>(
      *bus_, {[this](const fleet::Vehicle& vehicle, const Sender&) { vehicles_.insert(vehicle.id); }, {}, {}});
  service::hear<topics::VehicleState>(
      *bus_, {[this](const fleet::VehicleState& state, const Sender&) { vehicles_.insert(state.agv_id); }, {}, {}});

  service::hear<topics::NavigationStatus>(*bus_, {[this](const fleet::NavigationStatus& status, const Sender&) {
                                                    if (is_meant(status.agv_id, status.goal_id)) navigation_ = status;
                                                  },
                                                  {},
                                                  {}});

  service::hear<topics::Plan>(*bus_, {[this](const fleet::Plan& plan, const Sender&) {
                                        if (is_meant(plan.agv_id, plan.goal_id)) plan_ = plan;
                                      },
                                      {},
                                      {}});

  service::hear<topics::Goal>(*bus_, {[this](const fleet::Goal& goal, const Sender&) {
                                        if (goal.agv_id == agv_id_) goal_ = goal;
                                      },
                                      {},
                                      {}});
}

/// Whichever vehicle is given the goal is the one from then on, also when the goal is taken from it and given again.
bool GoalTalk::is_meant(const std::string& agv_id, const std::string& goal_id) {
  if (is_for_any_ && !said_goal_id_.empty() && goal_id == said_goal_id_) agv_id_ = agv_id;
  return agv_id == agv_id_;
}

/// A mistyped id is told with the ids that are there.
void GoalTalk::require_vehicle() {
  const auto is_there = [this] { return is_for_any_ ? !vehicles_.empty() : vehicles_.count(agv_id_) > 0; };
  if (run_until(*bus_, kUntilVehiclesAreSeen, is_there)) return;

  if (vehicles_.empty()) {
    throw config::BadEnvironment("no vehicle seen in " + place_of(cli_.settings) +
                                 "; aisle doctor looks for the cause");
  }

  const std::vector<std::string> seen(vehicles_.begin(), vehicles_.end());
  std::string names;

  for (const std::string& id : seen) names += (names.empty() ? "" : ", ") + id;

  const std::string nearest = config::nearest_name(agv_id_, seen);
  throw config::BadInput("no vehicle '" + agv_id_ + "'" + (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") +
                         " Seen are: " + names);
}

/// A goal that was sent before its reader was there is heard the next time.
bool GoalTalk::say_until(const fleet::Goal& goal, Seconds limit, const std::function<bool()>& done) {
  said_goal_id_ = goal.id;

  const auto end = std::chrono::steady_clock::now() + limit;
  while (!is_interrupted()) {
    auto sample = wire::encode(goal);
    sample.by(stamper_.next());
    writer_.write(sample);

    const Seconds left = end - std::chrono::steady_clock::now();
    if (run_until(*bus_, std::min<Seconds>(left, kSayAgainAfter), done)) return true;
    if (left <= Seconds::zero()) break;
  }

  return false;
}

}  // namespace aisle::cli
