#include "tools/cli/goal_talk.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"

namespace aisle::cli {
namespace {

constexpr Seconds kUntilVehiclesAreSeen{3.0};
constexpr std::chrono::milliseconds kSayAgainAfter{500};

}  // namespace

GoalTalk::GoalTalk(const Cli& cli, const std::string& agv_id)
    : cli_(cli),
      agv_id_(agv_id),
      bus_(join(cli, "aisle-goal")),
      writer_(bus_->writer<topics::Goal>()),
      stamper_(*bus_, "aisle", static_cast<std::uint64_t>(bus_->wall_clock_ns()) / 1000) {
  const auto is_data = [](const bus::SampleInfo& info) { return info.kind == bus::SampleKind::kData; };
  bus_->on<topics::VehicleInfo>([this, is_data](const aisle::VehicleInfo& sample, const bus::SampleInfo& info) {
    if (is_data(info)) vehicles_.insert(sample.agv_id().to_string());
  });
  bus_->on<topics::VehicleState>([this, is_data](const aisle::VehicleState& sample, const bus::SampleInfo& info) {
    if (is_data(info)) vehicles_.insert(sample.agv_id().to_string());
  });
  bus_->on<topics::NavigationStatus>(
      [this, is_data](const aisle::NavigationStatus& sample, const bus::SampleInfo& info) {
        if (is_data(info) && sample.agv_id().to_string() == agv_id_) navigation_ = sample;
      });
  bus_->on<topics::Plan>([this, is_data](const aisle::Plan& sample, const bus::SampleInfo& info) {
    if (is_data(info) && sample.agv_id().to_string() == agv_id_) plan_ = sample;
  });
  bus_->on<topics::Goal>([this, is_data](const aisle::Goal& sample, const bus::SampleInfo& info) {
    if (is_data(info) && sample.agv_id().to_string() == agv_id_) goal_ = sample;
  });
}

void GoalTalk::require_vehicle() {
  if (run_until(*bus_, kUntilVehiclesAreSeen, [this] { return vehicles_.count(agv_id_) > 0; })) return;
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

bool GoalTalk::say_until(aisle::Goal goal, Seconds limit, const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!is_interrupted()) {
    goal.by(stamper_.next());
    writer_.write(goal);
    const Seconds left = end - std::chrono::steady_clock::now();
    if (run_until(*bus_, std::min<Seconds>(left, kSayAgainAfter), done)) return true;
    if (left <= Seconds::zero()) break;
  }
  return false;
}

}  // namespace aisle::cli
