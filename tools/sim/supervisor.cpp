#include "tools/sim/supervisor.hpp"

#include <chrono>

#include "common/bus/topics.hpp"
#include "common/service/hear.hpp"

namespace aisle::sim {
namespace {

constexpr const char* kHost = "supervisor";
constexpr const char* kParticipant =
    "aisle-sign-off";  // as the command line names itself, and as the source of its word
constexpr const char* kSource = "aisle";
constexpr std::chrono::milliseconds kLook{500};

bus::Settings settings() {
  bus::Settings settings;
  settings.participant_name = kParticipant;
  return settings;
}

}  // namespace

Supervisor::Supervisor(bus::simulated::Network& network)
    : bus_(network.join(settings(), kHost)),
      stamper_(*bus_, kSource, static_cast<std::uint64_t>(bus_->wall_clock_ns()) / 1000),
      writer_(bus_->writer<topics::SignOff>()) {
  service::hear<topics::TrafficStatus>(
      *bus_, {[this](const fleet::TrafficStatus& status, const service::Sender& from) { take(status, from.by.epoch); },
              {},
              {}});

  bus_->every(kLook, [this] { look(); });
  bus_->drive();
}

/// A planner that has lost the lead may still speak, with its old epoch.
void Supervisor::take(const fleet::TrafficStatus& status, std::uint32_t epoch) {
  if (epoch < epoch_) return;

  epoch_ = epoch;
  silent_ = status.silent;
}

void Supervisor::look() {
  for (const fleet::SilentVehicle& vehicle : silent_) {
    const auto sign_off = signed_off_.find(vehicle.agv_id);
    if (sign_off == signed_off_.end()) continue;

    auto sample = wire::encode(sign_off->second);
    sample.by(stamper_.next());
    writer_.write(sample);
  }
}

}  // namespace aisle::sim
