#pragma once

#include <memory>

#include "common/bus/bus.hpp"

namespace aisle::bus {

/// One DDS participant and one event loop; samples go over the network, the clocks are this host's.
class DdsBus final : public Bus {
 public:
  /// @throws config::BadEnvironment when the participant cannot be made (no such interface, ports taken, bad
  /// certificate), config::BadInput for settings that fit no site
  explicit DdsBus(const Settings& settings);
  ~DdsBus() override;

  time::Stamp now() const override;
  std::int64_t wall_clock_ns() const override;
  void every(std::chrono::nanoseconds period, std::function<void()> handler) override;
  void on_incident(std::function<void(const Incident&)> handler) override;
  void post(std::function<void()> work) override;
  bool run_once(std::chrono::nanoseconds limit) override;
  int matched_writers(const std::string& topic) const override;
  std::vector<Endpoint> endpoints() const override;
  std::vector<Participant> peers() const override;
  const Settings& settings() const override;

 private:
  std::shared_ptr<detail::RawWriter> raw_writer(const char* topic, int strength) override;
  void raw_on(const char* topic, detail::RawHandler handler) override;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace aisle::bus
