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
#include "services/dispatcher/core/task_pool.hpp"
#include "services/dispatcher/dispatcher_memory.hpp"

namespace aisle::dispatcher {

/// What the process takes from its config file and its command line.
struct ServiceConfig {
  Settings settings;
  scenario::Scenario scenario;

  /// Second zero of the scenario, nanoseconds since the Unix epoch; none: when all vehicles are heard.
  std::optional<std::int64_t> start_at_ns;

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
  /// Recalls the state file, registers topics and timers with `shell`, which must outlive this object.
  DispatcherService(service::Shell& shell, const ServiceConfig& config);
  DispatcherService(const DispatcherService&) = delete;
  DispatcherService& operator=(const DispatcherService&) = delete;

 private:
  /// Registers what is read with the shell.
  void listen();

  /// A goal of a person or of another program: one for any vehicle is a task, a cancelled one ends mission or task.
  void take(const fleet::Goal& goal);

  /// Logs the answer to one of this process's map edits; answers to others are ignored.
  void take(const fleet::MapEditResult& result);

  /// One step of missions and tasks; writes its orders and the map edits that are due.
  void tick();

  /// Writes an order as a goal, and logs it.
  void write(const Order& order);

  /// One line for each event; a failure is also the service's last error.
  void log(const Event& event);

  /// Writes the state file when its text changed.
  void keep_memory();

  /// Counters, and the vehicles that were not heard yet.
  void report(service::Health& health) const;

  service::Shell& shell_;
  ServiceConfig config_;
  std::optional<DispatcherMemory> memory_;

  scenario::ScenarioClock clock_;
  Dispatcher dispatcher_;
  TaskPool tasks_;
  EditSchedule edits_;
  std::string map_id_;
  std::string kept_text_;  // of the state file

  service::Outbox<topics::Goal> goals_;
  service::Outbox<topics::MapEdit> map_edits_;
};

}  // namespace aisle::dispatcher
