#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/fleet/obstacle.hpp"
#include "common/scenario/scenario.hpp"
#include "common/service/shell.hpp"
#include "tools/sim/snapshot.hpp"

namespace aisle::sim {

/// Keeps the newest message of each kind that the site publishes, so that a run can be traced or drawn.
/// Writes nothing.
class Spectator {
 public:
  /// Hears the topics of `shell` from now on. Both must outlive it.
  Spectator(service::Shell& shell, const scenario::Scenario& scenario);
  Spectator(const Spectator&) = delete;
  Spectator& operator=(const Spectator&) = delete;

  /// What a local planner decided at the end of a cycle. Parts of it are on no topic.
  void hear(const std::string& agv_id, const local_planner::Output& output) { outputs_[agv_id] = output; }

  /// Whether the true pose of every vehicle is known.
  bool sees_all_vehicles() const { return vehicles_in_map_.size() == scenario_.vehicles.size(); }

  /// @pre sees_all_vehicles()
  Snapshot look(double t_s) const;

 private:
  void take(const fleet::Obstacle& truth);

  const scenario::Scenario& scenario_;
  std::map<std::string, geometry::Pose2> vehicles_in_map_;
  std::map<std::string, local_planner::Output> outputs_;
  std::map<std::string, geometry::Body> things_;
  std::map<std::uint64_t, fleet::Track> tracks_;
  std::map<std::string, fleet::Plan> plans_;
};

}  // namespace aisle::sim
