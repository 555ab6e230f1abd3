#pragma once

#include <cstdint>

#include "common/service/shell.hpp"
#include "tools/referee/core/judge.hpp"

namespace aisle::referee {

/// Listens to everything on the site, puts it on one clock (seconds since the service was made) and
/// hands it to the judge. Writes nothing but its own health.
///
/// Ground truth is placed by its stamp (the simulation's wall clock), everything else by its arrival.
class RefereeService {
 public:
  /// `shell` and `walls` must outlive the service.
  RefereeService(service::Shell& shell, const Walls& walls, const Expectation& expectation);

  /// Seconds since the service was made.
  double now_s() const;
  const Judge& judge() const { return judge_; }
  bool is_over() const { return judge_.is_over(now_s()); }

  /// Judges what is left and closes the books.
  RunReport finish();

 private:
  void listen_to_simulation();
  void listen_to_fleet();
  void listen_to_map_and_services();
  void take(const fleet::Obstacle& truth, const service::Sender& from);
  void take(const fleet::VehicleState& state, const service::Sender& from);
  void take(const fleet::Plan& plan, const service::Sender& from);
  void take(const fleet::Goal& goal, const service::Sender& from);
  void take(const fleet::NavigationStatus& status, const service::Sender& from);
  void take(const fleet::MapEdit& edit, const service::Sender& from);
  void take(const fleet::MapEditResult& answer, const service::Sender& from);
  double arrived_s(const service::Sender& from) const;

  service::Shell& shell_;
  Judge judge_;
  time::Stamp started_;
  std::int64_t started_wall_ns_;
};

}  // namespace aisle::referee
