#pragma once

#include <functional>
#include <memory>
#include <string>

#include "common/bus/simulated/network.hpp"
#include "common/service/shell.hpp"
#include "tools/sim/disk.hpp"

namespace aisle::sim {

/// How to build a process, each time that it starts.
struct Blueprint {
  std::string service;  // "local-planner"
  std::string agv_id;   // of a service for one vehicle, else empty

  /// Part of the simulated world rather than of the product: its messages to its kind are the laws of nature, which no
  /// fault breaks, and no pattern of a fault plan hits it.
  bool is_world{false};
  std::function<std::shared_ptr<void>(service::Shell&)> make;

  std::string role{};  // of several of a service: what tells this one from the others

  /// "local-planner-agv-1": its instance id, its name in fault plans, and its host.
  std::string name() const { return service + (agv_id.empty() ? "" : "-" + agv_id) + (role.empty() ? "" : "-" + role); }
};

/// One process of a simulated site, on a host of its own: a service on a simulated bus, and a disk that outlives it.
///
///   down ──start──► up ──hang──► hanging ──go_on──► up
///    ▲               │              │
///    └─────crash─────┴──────────────┘
class Process {
 public:
  /// `network` must outlive it. `log` takes what its service logs. `on_death(why)` is called when its service throws;
  /// the process is down then.
  Process(bus::simulated::Network& network, Blueprint blueprint, std::shared_ptr<spdlog::logger> log,
          std::function<void(const std::string&)> on_death);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// As given to the constructor.
  const Blueprint& blueprint() const { return blueprint_; }
  const std::string& name() const { return name_; }

  /// Up, or hanging.
  bool is_up() const { return running_ != nullptr; }
  Disk& disk() { return disk_; }

  /// Builds the service from its blueprint. Does nothing when the process is up already. This and the
  /// following must not be called in a turn of its bus.
  void start();

  /// Ends without a word; everything that was not synced to its disk is lost.
  void crash();

  /// Its loop stands while it hangs.
  void hang(bool hangs);

 private:
  struct Running;

  /// Runs its loop; an exception of the service ends the process.
  void turn();

  bus::simulated::Network& network_;
  Blueprint blueprint_;
  std::string name_;
  std::shared_ptr<spdlog::logger> log_;
  std::function<void(const std::string&)> on_death_;
  Disk disk_;
  std::unique_ptr<Running> running_;
};

}  // namespace aisle::sim
