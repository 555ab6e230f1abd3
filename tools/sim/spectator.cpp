#include "tools/sim/spectator.hpp"

namespace aisle::sim {

Spectator::Spectator(service::Shell& shell, const scenario::Scenario& scenario) : scenario_(scenario) {
  shell.inbox<topics::WorldObstacle>([this](const fleet::Obstacle& truth) { take(truth); })
      .on_gone([this](const std::string& id, service::End) { things_.erase(id); });

  shell.inbox<topics::Track>([this](const fleet::Track& track) { tracks_[track.id] = track; })
      .on_gone([this](std::uint64_t id, service::End) { tracks_.erase(id); });

  shell.inbox<topics::Plan>([this](const fleet::Plan& plan) { plans_[plan.agv_id] = plan; });
}

void Spectator::take(const fleet::Obstacle& truth) {
  if (truth.kind == fleet::Obstacle::Kind::kVehicle) {
    vehicles_in_map_[truth.id] = truth.base_in_map;
  } else {
    things_[truth.id] = truth.body();
  }
}

Snapshot Spectator::look(double t_s) const {
  Snapshot now;
  now.t_s = t_s;

  for (const scenario::Vehicle& vehicle : scenario_.vehicles) {
    now.vehicles_in_map.push_back(vehicles_in_map_.at(vehicle.id));

    const auto output = outputs_.find(vehicle.id);
    now.outputs.push_back(output == outputs_.end() ? local_planner::Output{} : output->second);

    const auto plan = plans_.find(vehicle.id);
    now.plans.push_back(plan == plans_.end() ? nullptr : &plan->second);
  }

  for (const auto& [id, body] : things_) now.things.push_back(body);
  for (const auto& [id, track] : tracks_) now.tracks.push_back(track);

  return now;
}

}  // namespace aisle::sim
