#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/scenario/scenario.hpp"
#include "common/scenario/scenario_clock.hpp"
#include "common/service/shell.hpp"
#include "services/dispatcher/core/dispatcher.hpp"
#include "services/dispatcher/core/edit_schedule.hpp"
#include "services/dispatcher/dispatcher_memory.hpp"

namespace aisle::dispatcher {

struct ServiceConfig {
  Settings settings;
  scenario::Scenario scenario;
  std::optional<std::int64_t>
      start_at_ns;                   // second zero of the scenario, Unix epoch; none: when all vehicles are heard
  std::filesystem::path state_file;  // empty: nothing is kept

  template <class Reader>
  void describe(Reader& r) {
    settings.describe(r);
  }
};

/// Between the bus and the dispatcher. Tells its progress in the counters goals_assigned, goals_reached, goals_failed
/// and missions_done (1 when nothing is left to do) on `service_health`.
class DispatcherService {
 public:
  DispatcherService(service::Shell& shell, const ServiceConfig& config);
  DispatcherService(const DispatcherService&) = delete;
  DispatcherService& operator=(const DispatcherService&) = delete;

 private:
  void listen();
  void take(const fleet::MapEditResult& result);
  void tick();
  void write(const Order& order);
  void log(const Event& event);
  void keep_memory();
  void report(service::Health& health) const;

  service::Shell& shell_;
  ServiceConfig config_;
  std::optional<DispatcherMemory> memory_;
  scenario::ScenarioClock clock_;
  Dispatcher dispatcher_;
  EditSchedule edits_;
  std::string map_id_;
  std::string kept_text_;
  service::Outbox<topics::Goal> goals_;
  service::Outbox<topics::MapEdit> map_edits_;
};

}  // namespace aisle::dispatcher
