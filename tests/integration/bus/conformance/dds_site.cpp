#include <csignal>
#include <thread>
#include <utility>

#include "common/bus/dds/dds_bus.hpp"
#include "common/bus/dds/type_table.hpp"
#include "tests/integration/bus/conformance/conformance_site.hpp"
#include "tests/integration/bus/stranger.hpp"
#include "tests/integration/bus/two_buses.hpp"
#include "tests/support/child_process.hpp"

namespace aisle::bus_test {
namespace {

constexpr int kFirstDomain = 34, kDomains = 31;  // each case has two: its own, and another

class ProcessPeer final : public Peer {
 public:
  explicit ProcessPeer(const std::vector<std::string>& command) : process_(command) {}
  void kill() override { process_.signal(SIGKILL); }
  void freeze(bool frozen) override { process_.signal(frozen ? SIGSTOP : SIGCONT); }
  void leave() override { process_.signal(SIGTERM); }

 private:
  test_support::ChildProcess process_;
};

class DdsSite final : public ConformanceSite {
 public:
  DdsSite() {
    static int cases = 0;
    domain_ = kFirstDomain + 2 * (cases++ % kDomains);
  }
  std::unique_ptr<Bus> join(const std::string& name, const std::string& partition, bool other_domain) override {
    bus::Settings settings = loopback(other_domain ? domain_ + 1 : domain_, name);
    settings.partition = partition;
    return std::make_unique<DdsBus>(settings);
  }
  std::unique_ptr<Peer> start(const std::string& name, const std::string& role, int strength) override {
    return std::make_unique<ProcessPeer>(
        std::vector<std::string>{BUS_TEST_PEER, std::to_string(domain_), "", name, role, std::to_string(strength)});
  }
  std::shared_ptr<void> foreign_writer(const std::string& topic, const bus::Qos& qos,
                                       const std::string& type_of) override {
    auto stranger = std::make_shared<Stranger>(domain_);
    stranger->writer(topic.c_str(), bus::topic_type(type_of).make_support(), qos);
    return stranger;
  }
  time::Stamp now() const override { return std::chrono::steady_clock::now().time_since_epoch(); }
  void idle(std::chrono::milliseconds time) override { std::this_thread::sleep_for(time); }

 private:
  int domain_{0};
};

}  // namespace

std::unique_ptr<ConformanceSite> dds_site() { return std::make_unique<DdsSite>(); }

}  // namespace aisle::bus_test
