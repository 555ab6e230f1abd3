#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "common/fleet/leadership.hpp"
#include "common/service/shell.hpp"
#include "services/global-planner/core/parameters.hpp"
#include "services/global-planner/core/slice_times.hpp"
#include "services/global-planner/core/traffic_planner.hpp"

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

/// Plans for all vehicles and grants them road, as the leader, or as a standby that takes over when the leader is gone.
/// Works one slice a turn of the loop, so that samples are handled in between. The writers of `plan` and `grant` exist
/// only while this planner leads.
///
/// A planner that takes over knows nothing of what the former one granted: it hears it from the vehicles' statuses.
class GlobalPlannerService {
 public:
  /// @throws config::BadInput for an unknown planner, std::invalid_argument for parameters that it has not
  GlobalPlannerService(service::Shell& shell, const ServiceConfig& config);
  GlobalPlannerService(const GlobalPlannerService&) = delete;
  GlobalPlannerService& operator=(const GlobalPlannerService&) = delete;

 private:
  /// Registers what is read with the shell.
  void listen();

  /// A plan of another planner: its epoch decides who leads.
  void hear_planner(const fleet::Origin& by);

  /// A vehicle obeys that planner. If it outranks this one in the same epoch, both lead, or did while the network was
  /// split: this one stands by.
  void hear_obeyed(const fleet::Claim& claim);

  /// Epochs that other services have heard of, so that a restarted planner begins above them.
  void hear(const fleet::ServiceHealth& health, const fleet::Origin& by);

  /// Is this planner the one whose plans are heard?
  bool leads() const { return leadership_.role() == fleet::Leadership::Role::kLeading; }

  /// Leads or stands by, as the leadership says, and claims or releases the topic when that changes.
  void keep_lead();

  /// Works for one slice, and publishes what comes of it.
  void work();

  /// The leader's word that it lives, and what it says of the traffic.
  void publish_status();

  /// Of the writers of plans and grants.
  void assert_liveliness();

  /// No plan is asked for: the memory of searches, some bytes a cell of the map, is given back.
  void rest_after_searches();

  /// Has the search that began then taken too long? Also asserts liveliness meanwhile.
  bool is_too_late(time::Stamp begun);

  /// Counters, and what keeps vehicles from being planned for.
  void report(service::Health& health) const;

  service::Shell& shell_;
  ServiceConfig config_;
  service::MapClient& map_;
  TrafficPlanner fleet_;

  fleet::Leadership leadership_;
  service::Inbox<topics::Plan> heard_plans_;
  service::Outbox<topics::Plan> plans_;  // open while this planner leads, as is `grant`
  service::Outbox<topics::Grant> grants_;
  service::Outbox<topics::TrafficStatus> statuses_;
  std::uint64_t beat_{0};
  SliceTimes slices_;
  std::string followed_;  // the leader whose plans were heard last
  time::Stamp asserted_{};
  std::uint64_t searches_before_rest_{0};
  std::function<void()> work_soon_;
};

}  // namespace aisle::global_planner
