#include "tools/sim/process.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace aisle::sim {

struct Process::Running {
  std::unique_ptr<bus::simulated::SimulatedBus> bus;
  std::unique_ptr<service::Shell> shell;
  std::shared_ptr<void> service;
  bool is_dying{false};
};

Process::Process(bus::simulated::Network& network, Blueprint blueprint, std::shared_ptr<spdlog::logger> log,
                 std::function<void(const std::string&)> on_death)
    : network_(network),
      blueprint_(std::move(blueprint)),
      name_(blueprint_.name()),
      log_(std::move(log)),
      on_death_(std::move(on_death)) {}

Process::~Process() {
  if (is_up()) crash();
}

/// A service that throws while it is built ends the process at once.
void Process::start() {
  if (is_up()) return;

  const ScopedDisk scope(disk_);
  bus::Settings settings;

  settings.participant_name = name_;
  running_ = std::make_unique<Running>();
  running_->bus = network_.join(settings, name_);

  service::Identity identity;
  identity.service = blueprint_.service;
  identity.instance_id = name_;
  identity.agv_id = blueprint_.agv_id;

  // A wall clock that jumped back gives an older boot id, as on a real host.
  identity.boot_id = static_cast<std::uint64_t>(running_->bus->wall_clock_ns()) / 1000;
  identity.host = name_;
  identity.process_id = 1;

  service::Surroundings surroundings;
  surroundings.log = log_;

  try {
    running_->shell = std::make_unique<service::Shell>(*running_->bus, identity, surroundings);
    running_->service = blueprint_.make(*running_->shell);
  } catch (const std::exception& error) {
    crash();
    return on_death_(error.what());
  }

  running_->bus->drive([this] { turn(); });
}

/// The end is put off to the next event, since a bus must not be destroyed within its own turn.
void Process::turn() {
  const ScopedDisk scope(disk_);
  try {
    running_->bus->run_once(std::chrono::nanoseconds(0));
  } catch (const std::exception& error) {
    if (std::exchange(running_->is_dying, true)) return;

    network_.at(network_.now(), [this, dying = running_.get(), why = std::string(error.what())] {
      if (running_.get() != dying) return;  // a fault was faster
      crash();
      on_death_(why);
    });
  }
}

/// Bus first, then service: a service that goes says nothing to others.
void Process::crash() {
  if (!is_up()) return;

  const ScopedDisk scope(disk_);
  auto files = disk_.as_synced();

  running_->bus->crash();
  running_->service.reset();  // what destructors still write to the disk is taken back
  running_.reset();
  disk_.restore(std::move(files));
}

void Process::hang(bool hangs) {
  if (is_up()) running_->bus->hang(hangs);
}

}  // namespace aisle::sim
