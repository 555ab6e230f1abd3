#include "common/wire/service.hpp"

#include <cstddef>
#include <utility>

namespace aisle::wire {
namespace {

constexpr std::size_t kMostCounters = 32;  // as in the IDL

/// Enumerators: see planning.cpp.
aisle::ServiceState to_wire(fleet::ServiceState value) {
  switch (value) {
    case fleet::ServiceState::kStarting:
      return ServiceState::SERVICE_STARTING;
    case fleet::ServiceState::kWaiting:
      return ServiceState::SERVICE_WAITING;
    case fleet::ServiceState::kReady:
      return ServiceState::SERVICE_READY;
    case fleet::ServiceState::kDegraded:
      return ServiceState::SERVICE_DEGRADED;
    case fleet::ServiceState::kStopping:
      return ServiceState::SERVICE_STOPPING;
  }

  return {};
}

std::optional<fleet::ServiceState> from_wire(aisle::ServiceState value) {
  switch (value) {
    case ServiceState::SERVICE_STARTING:
      return fleet::ServiceState::kStarting;
    case ServiceState::SERVICE_WAITING:
      return fleet::ServiceState::kWaiting;
    case ServiceState::SERVICE_READY:
      return fleet::ServiceState::kReady;
    case ServiceState::SERVICE_DEGRADED:
      return fleet::ServiceState::kDegraded;
    case ServiceState::SERVICE_STOPPING:
      return fleet::ServiceState::kStopping;
  }

  return std::nullopt;
}

}  // namespace

aisle::ServiceHealth encode(const fleet::ServiceHealth& health) {
  aisle::ServiceHealth sample;
  sample.instance_id(health.instance_id);
  sample.service(health.service);
  sample.software_version(health.software_version);
  sample.idl_version(health.idl_version);

  sample.host(health.host);
  sample.process_id(health.process_id);
  sample.agv_id(health.agv_id);

  sample.map_id(health.map_id);
  sample.map_revision(health.map_revision);
  sample.map_hash(health.map_hash);

  sample.state(to_wire(health.state));
  sample.waits_for(health.waits_for);
  sample.last_error(health.last_error);

  sample.wall_clock_ns(health.wall_clock_ns);
  sample.cpu_percent(health.cpu_percent);
  sample.resident_mb(health.resident_mb);

  for (const auto& [name, value] : health.counters) {
    if (sample.counters().size() == kMostCounters) break;

    aisle::Counter counter;
    counter.name(name);
    counter.value(value);
    sample.counters().push_back(counter);
  }

  return sample;
}

Decoded<fleet::ServiceHealth> decode(const aisle::ServiceHealth& sample) {
  Checks checks;
  fleet::ServiceHealth health;

  health.instance_id = sample.instance_id().to_string();
  health.service = sample.service().to_string();
  health.software_version = sample.software_version().to_string();
  health.idl_version = sample.idl_version();

  health.host = sample.host().to_string();
  health.process_id = sample.process_id();
  health.agv_id = sample.agv_id().to_string();

  health.map_id = sample.map_id().to_string();
  health.map_revision = sample.map_revision();
  health.map_hash = sample.map_hash();

  health.state = checks.known("state", sample.state(), from_wire(sample.state()));
  health.waits_for = sample.waits_for().to_string();
  health.last_error = sample.last_error().to_string();

  health.wall_clock_ns = sample.wall_clock_ns();
  health.cpu_percent = sample.cpu_percent();
  health.resident_mb = sample.resident_mb();

  checks.id("instance_id", health.instance_id)
      .optional_id("service", health.service)
      .optional_id("software_version", health.software_version)
      .optional_id("host", health.host)
      .optional_id("agv_id", health.agv_id)
      .optional_id("map_id", health.map_id)
      .finite("cpu_percent", health.cpu_percent)
      .finite("resident_mb", health.resident_mb)
      .count("counters", sample.counters().size(), 0, kMostCounters);

  for (const aisle::Counter& counter : sample.counters()) health.counters[counter.name().to_string()] = counter.value();

  return checks.decoded(std::move(health));
}

}  // namespace aisle::wire
