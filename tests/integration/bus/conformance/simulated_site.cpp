#include <utility>
#include <vector>

#include "common/bus/sample_codec.hpp"
#include "common/bus/simulated/network.hpp"
#include "tests/integration/bus/conformance/conformance_site.hpp"
#include "tests/integration/bus/roles.hpp"

namespace aisle::bus_test {
namespace {

using bus::simulated::Network;
using bus::simulated::SimulatedBus;

class SimulatedPeer final : public Peer {
 public:
  SimulatedPeer(std::unique_ptr<SimulatedBus> bus, const std::string& role, const std::string& name, int strength)
      : bus_(std::move(bus)) {
    play_role(*bus_, role, name, strength);
    bus_->drive();
  }
  void kill() override { bus_->crash(); }
  void freeze(bool frozen) override { bus_->freeze(frozen); }
  void leave() override { bus_.reset(); }

 private:
  std::unique_ptr<SimulatedBus> bus_;
};

/// Each process on a host of its own.
class SimulatedSite final : public ConformanceSite {
 public:
  std::unique_ptr<Bus> join(const std::string& name, const std::string& partition, bool other_domain) override {
    return join_network(name, partition, other_domain);
  }
  std::unique_ptr<Peer> start(const std::string& name, const std::string& role, int strength) override {
    return std::make_unique<SimulatedPeer>(join_network(name, "", false), role, name, strength);
  }
  std::shared_ptr<void> foreign_writer(const std::string& topic, const bus::Qos& qos,
                                       const std::string& type_of) override {
    std::shared_ptr<SimulatedBus> stranger = join_network("stranger", "", false);
    stranger->announce_as(topic, qos, bus::sample_codec(type_of).type_name());
    writers_.push_back(stranger->writer<topics::Goal>());
    return stranger;
  }
  time::Stamp now() const override { return network_.now(); }
  void idle(std::chrono::milliseconds time) override { network_.advance_to(network_.now() + time); }

 private:
  std::unique_ptr<SimulatedBus> join_network(const std::string& name, const std::string& partition, bool other_domain) {
    bus::Settings settings;
    settings.domain = other_domain ? 1 : 0;
    settings.partition = partition;
    settings.participant_name = name;
    return network_.join(settings, name);
  }

  Network network_{1};
  std::vector<bus::Writer<topics::Goal>> writers_;
};

}  // namespace

std::unique_ptr<ConformanceSite> simulated_site() { return std::make_unique<SimulatedSite>(); }

}  // namespace aisle::bus_test
