#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "common/bus/bus.hpp"
#include "common/bus/topics.hpp"
#include "common/fleet/goal.hpp"
#include "common/fleet/navigation.hpp"
#include "common/fleet/plan.hpp"
#include "common/service/origin_stamper.hpp"
#include "tools/cli/cli.hpp"

namespace aisle::cli {

/// Speaks with the planners about one vehicle's goal: repeats a goal twice a second until it is
/// answered, and keeps the newest answers.
class GoalTalk {
 public:
  /// Joins the site. @throws config::BadEnvironment
  GoalTalk(const Cli& cli, const std::string& agv_id);

  /// Waits until the vehicle is seen; for any vehicle, until one is. @throws config::BadInput with the vehicles that
  /// are seen instead, config::BadEnvironment when there are none
  void require_vehicle();

  /// Runs the loop as run_until() does, and writes `goal` at once and every 500 ms meanwhile.
  bool say_until(const fleet::Goal& goal, Seconds limit, const std::function<bool()>& done);

  /// The same without saying anything.
  bool listen_until(Seconds limit, const std::function<bool()>& done) { return run_until(*bus_, limit, done); }

  /// Of a goal for any vehicle: "any" until a vehicle was given it.
  const std::string& agv_id() const { return agv_id_; }

  /// The newest that was heard of this vehicle; the same for navigation() and goal().
  const std::optional<fleet::Plan>& plan() const { return plan_; }
  const std::optional<fleet::NavigationStatus>& navigation() const { return navigation_; }
  const std::optional<fleet::Goal>& goal() const { return goal_; }

  /// Is there a reader of goals besides its own?
  bool is_read_by_anybody() const { return writer_.matched_readers() > 1; }

 private:
  /// Is this a word of the vehicle that this is about? A goal for any vehicle tells which vehicle that is.
  bool is_meant(const std::string& agv_id, const std::string& goal_id);

  const Cli& cli_;
  std::string agv_id_;
  bool is_for_any_;
  std::string said_goal_id_;
  std::unique_ptr<bus::Bus> bus_;
  bus::Writer<topics::Goal> writer_;
  service::OriginStamper stamper_;
  std::set<std::string> vehicles_;
  std::optional<fleet::Plan> plan_;
  std::optional<fleet::NavigationStatus> navigation_;
  std::optional<fleet::Goal> goal_;  // of others
};

}  // namespace aisle::cli
