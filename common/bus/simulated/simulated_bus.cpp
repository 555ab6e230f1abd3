#include "common/bus/simulated/simulated_bus.hpp"

#include <utility>

#include "common/bus/simulated/core.hpp"

namespace aisle::bus::simulated {
namespace {

/// See bus.hpp. Outlives its bus, and the network, without harm.
class SimulatedWriter final : public detail::RawWriter {
 public:
  SimulatedWriter(Core& core, std::shared_ptr<WriterEnd> end) : core_(core.weak_from_this()), end_(std::move(end)) {}

  ~SimulatedWriter() override {
    if (const auto core = core_.lock()) end_->close();
  }

  SimulatedWriter(const SimulatedWriter&) = delete;
  SimulatedWriter& operator=(const SimulatedWriter&) = delete;

  bool write(const void* sample) override { return end_->write(sample); }
  bool dispose(const void* sample) override { return end_->dispose(sample); }
  void assert_liveliness() override { end_->assert_liveliness(); }
  int matched_readers() const override { return end_->matched_readers(); }

  bool wait_until_acknowledged(std::chrono::milliseconds limit) override {
    const auto core = core_.lock();
    return core && core->wait(core->now() + limit, [this] { return end_->is_acknowledged(); });
  }

 private:
  std::weak_ptr<Core> core_;
  std::shared_ptr<WriterEnd> end_;
};

}  // namespace

SimulatedBus::SimulatedBus(std::shared_ptr<Core> core, std::shared_ptr<Process> process)
    : core_(std::move(core)), process_(std::move(process)) {}

SimulatedBus::~SimulatedBus() { core_->leave(*process_); }

time::Stamp SimulatedBus::now() const { return core_->now(); }
std::int64_t SimulatedBus::wall_clock_ns() const { return core_->wall_clock_ns(process_->host); }

void SimulatedBus::every(std::chrono::nanoseconds period, std::function<void()> handler) {
  process_->every(period, std::move(handler));
}

void SimulatedBus::on_incident(std::function<void(const Incident&)> handler) {
  process_->incident_handlers.push_back(std::move(handler));
}

void SimulatedBus::post(std::function<void()> work) { process_->post(std::move(work)); }
bool SimulatedBus::run_once(std::chrono::nanoseconds limit) { return process_->run_once(limit); }

int SimulatedBus::matched_writers(const std::string& topic) const {
  const auto found = process_->readers.find(topic);
  return found == process_->readers.end() ? 0 : found->second->matched_writers();
}

std::vector<Endpoint> SimulatedBus::endpoints() const { return process_->endpoints(); }
std::vector<Participant> SimulatedBus::peers() const { return process_->peers(); }
const Settings& SimulatedBus::settings() const { return process_->settings; }

void SimulatedBus::drive(std::function<void()> turn) {
  process_->turn = std::move(turn);
  process_->driven = true;
  core_->give_turn(*process_);
}

void SimulatedBus::set_turn_time(std::chrono::nanoseconds time) { process_->turn_time = time; }

void SimulatedBus::hang(bool hung) {
  process_->hung = hung;
  if (!hung) core_->give_turn(*process_);
}

void SimulatedBus::freeze(bool frozen) { core_->freeze(*process_, frozen); }
void SimulatedBus::crash() { core_->crash(*process_); }
bool SimulatedBus::has_crashed() const { return process_->crashed; }

void SimulatedBus::announce_as(const std::string& topic, const Qos& qos, const std::string& type_name) {
  process_->announced_as[topic] = Announced{topic, type_name, false, qos, false};
}

std::shared_ptr<detail::RawWriter> SimulatedBus::raw_writer(const char* topic, int strength) {
  return std::make_shared<SimulatedWriter>(*core_, process_->add_writer(topic, strength));
}

void SimulatedBus::raw_on(const char* topic, detail::RawHandler handler) {
  process_->reader(topic).add(std::move(handler));
}

}  // namespace aisle::bus::simulated
