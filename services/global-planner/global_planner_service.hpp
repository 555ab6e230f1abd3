#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "common/fleet/leadership.hpp"
#include "common/service/shell.hpp"
#include "services/global-planner/core/fleet_planner.hpp"
#include "services/global-planner/core/parameters.hpp"

namespace aisle::global_planner {

/// What the process takes from its config file and its command line.
struct ServiceConfig {
  std::string planner{"direct"};  // a name in core/variants
  int strength{100};              // of this planner among those of one epoch; the highest is heard
  bool standby{false};            // waits until the leader is gone
  double longest_search_s{1.0};   // then a search ends without a plan
  FleetSettings fleet;
  Parameters parameters{};  // of the planner, for experiments; no key of the config file

  template <class Reader>
  void describe(Reader& r) {
    r.field("planner", planner)
        .field("strength", strength, 0, 999)
        .field("standby", standby)
        .field("longest_search_s", longest_search_s, 0.01, 60.0)
        .section("fleet", fleet);
  }
};

/// Plans for all vehicles, as the leader or as a standby that follows the leader's plans and takes over when the leader
/// is gone. Makes at most one plan a turn of the loop, so that samples are handled in between. The `plan` writer exists
/// only while this planner leads.
class GlobalPlannerService {
 public:
  /// @throws config::BadInput for an unknown planner, std::invalid_argument for parameters that it has not
  GlobalPlannerService(service::Shell& shell, const ServiceConfig& config);
  GlobalPlannerService(const GlobalPlannerService&) = delete;
  GlobalPlannerService& operator=(const GlobalPlannerService&) = delete;

 private:
  /// Registers what is read with the shell.
  void listen();

  /// A plan of another planner: its epoch decides who leads, and a standby adopts the plan.
  void hear(const fleet::Plan& plan, const fleet::Origin& by);

  /// Epochs that other services have heard of, so that a restarted planner begins above them.
  void hear(const fleet::ServiceHealth& health, const fleet::Origin& by);

  /// Is this planner the one whose plans are heard?
  bool leads() const { return leadership_.role() == fleet::Leadership::Role::kLeading; }

  /// Leads or stands by, as the leadership says, and claims or releases the topic when that changes.
  void keep_lead();

  /// Attends to one vehicle, and publishes what comes of it.
  void work();

  /// No plan is asked for: the memory of searches, some bytes a cell of the map, is given back.
  void rest_after_searches();

  /// Has the search that began then taken too long? Also asserts liveliness meanwhile.
  bool is_too_late(time::Stamp begun);

  /// Counters, and what keeps vehicles from being planned for.
  void report(service::Health& health) const;

  service::Shell& shell_;
  ServiceConfig config_;
  service::MapClient& map_;
  FleetPlanner fleet_;

  fleet::Leadership leadership_;
  service::Inbox<topics::Plan> heard_plans_;
  service::Outbox<topics::Plan> plans_;  // open while this planner leads
  std::string followed_;                 // the leader whose plans were heard last
  time::Stamp asserted_{};
  std::uint64_t searches_before_rest_{0};
  std::function<void()> work_soon_;
};

}  // namespace aisle::global_planner
