#include "common/bus/simulated/network.hpp"

#include <utility>

#include "common/bus/simulated/core.hpp"

namespace aisle::bus::simulated {

Network::Network(std::uint64_t seed, const Options& options) : core_(std::make_shared<Core>(seed, options)) {}
Network::~Network() = default;

std::unique_ptr<SimulatedBus> Network::join(const Settings& settings, const std::string& host) {
  return std::make_unique<SimulatedBus>(core_, core_->join(settings, host));
}

time::Stamp Network::now() const { return core_->now(); }
void Network::advance_to(time::Stamp time) { core_->advance_to(time); }
bool Network::step() { return core_->step(); }
void Network::at(time::Stamp time, std::function<void()> action) { core_->at(time, std::move(action)); }

void Network::set_link(const std::string& from, const std::string& to, const Link& link) {
  core_->set_link(from, to, link);
}

const Link& Network::link(const std::string& from, const std::string& to) const {
  Links& links = core_->links();
  return links.link(links.host(from), links.host(to));
}

void Network::set_all_links(const Link& link) { core_->set_all_links(link); }

void Network::set_cut(const std::string& from, const std::string& to, bool cut) {
  Link changed = link(from, to);
  changed.cut = cut;
  core_->set_link(from, to, changed);
}

void Network::set_wall_clock_offset(const std::string& host, std::chrono::nanoseconds offset) {
  core_->set_wall_clock_offset(core_->links().host(host), offset);
}

const Tally& Network::tally() const { return core_->links().tally(); }
const Options& Network::options() const { return core_->options(); }

}  // namespace aisle::bus::simulated
