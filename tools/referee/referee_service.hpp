#pragma once
#include <cstdint>
#include <string>

#include "common/bus/bus.hpp"
#include "common/service/shell.hpp"
#include "tools/referee/core/judge.hpp"

namespace aisle::referee {

/// Hears everything on the site, puts it on one clock (seconds since it was made) and hands it to the judge. Writes
/// nothing but its own health. Ground truth is placed by its stamp, everything else by its arrival.
class RefereeService {
 public:
  /// `bus`, `health` and `walls` must outlive the service.
  RefereeService(bus::Bus& bus, service::Health& health, const Walls& walls, const Expectation& expectation);

  double now_s() const;
  const Judge& judge() const { return judge_; }
  bool is_over() const { return judge_.is_over(now_s()); }
  RunReport finish();

 private:
  void listen_to_simulation(bus::Bus& bus);
  void listen_to_fleet(bus::Bus& bus);
  void listen_to_map(bus::Bus& bus);
  void listen_to_services(bus::Bus& bus);
  void take(const aisle::WorldObstacle& sample);
  void take(const aisle::VehicleState& sample, double t_s);
  void take(const aisle::Plan& sample, double t_s);
  void take(const aisle::Goal& sample, double t_s);
  void take(const aisle::NavigationStatus& sample, double t_s);
  void take(const aisle::MapEdit& sample, double t_s);
  void take(const aisle::MapEditResult& sample, double t_s);
  /// False, and counted, when a sample is not fit to be judged.
  bool fit(const char* topic, bool ok);
  double arrived_s(const bus::SampleInfo& info) const;

  bus::Bus& bus_;
  service::Health& health_;
  Judge judge_;
  time::Stamp started_;
  std::int64_t started_wall_ns_;
};

}  // namespace aisle::referee
