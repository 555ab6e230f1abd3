#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "common/bus/bus.hpp"
#include "common/fleet/leadership.hpp"
#include "common/process/log.hpp"
#include "common/service/map_client.hpp"
#include "common/service/origin_stamper.hpp"
#include "common/service/shell.hpp"
#include "common/wire/checks.hpp"
#include "services/global-planner/core/fleet_planner.hpp"

namespace aisle::global_planner {

struct ServiceConfig {
  std::string planner{"direct"};  // a name in core/variants
  int strength{100};              // of this planner among those of one epoch; the highest is heard
  bool standby{false};            // does not lead before the leader is gone
  double longest_search_s{1.0};
  FleetSettings fleet;

  template <class Reader>
  void describe(Reader& r) {
    r.field("planner", planner)
        .field("strength", strength, 0, 999)
        .field("standby", standby)
        .field("longest_search_s", longest_search_s, 0.01, 60.0)
        .section("fleet", fleet);
  }
};

/// Between the bus and the fleet planner. Makes at most one plan a turn of the loop, so that samples are handled in
/// between; the `plan` writer exists only while this planner leads.
class GlobalPlannerService {
 public:
  /// @throws config::BadInput for an unknown planner
  GlobalPlannerService(bus::Bus& bus, const std::string& instance_id, std::uint64_t boot_id, service::Health& health,
                       const ServiceConfig& config);
  GlobalPlannerService(const GlobalPlannerService&) = delete;
  GlobalPlannerService& operator=(const GlobalPlannerService&) = delete;

 private:
  void listen();
  void hear(const aisle::Plan& sample, const bus::SampleInfo& info);
  void keep_lead();
  void work();
  void work_soon();
  /// Nobody waits for a plan: what searches need, some bytes a cell of the map, is given back.
  void rest_after_searches();
  bool is_too_late(time::Stamp begun);
  void report();
  /// Nothing when the sample must be dropped, which is counted and said.
  template <class T>
  std::optional<T> accepted(const char* topic, wire::Decoded<T> decoded);

  bus::Bus& bus_;
  ServiceConfig config_;
  std::uint64_t boot_id_;
  service::Health& health_;
  service::OriginStamper stamper_;
  service::MapClient map_;
  FleetPlanner fleet_;
  fleet::Leadership leadership_;
  bus::Writer<topics::Plan> plans_;
  std::string followed_;  // the leader whose plans were heard last
  time::Stamp asserted_{};
  std::uint64_t searches_before_rest_{0};
  bool is_work_posted_{false};
  process::LimitedWarnings warnings_;
};

}  // namespace aisle::global_planner
