#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "common/grid/clearance.hpp"
#include "common/scenario/scenario.hpp"
#include "services/global-planner/core/traffic/coordinator.hpp"
#include "tools/lab/traffic/floor_judge.hpp"
#include "tools/lab/traffic/kinematic_vehicle.hpp"
#include "tools/sim/standoffs.hpp"

namespace aisle::lab {

/// What disturbs a run. All of it is drawn by seed.
struct Disturbance {
  double loss{0.0};            // share of the reports and orders that is lost; a lost order is sent again
  double least_delay_s{0.02};  // of every message
  double most_delay_s{0.06};
  double holds_a_minute{0.0};  // of each vehicle, by a person
  double least_hold_s{2.0};
  double most_hold_s{8.0};
  double slower_by{0.0};  // each vehicle's top speed is lower by 0 to this share

  /// Holds of 2 to 8 s a minute, top speeds up to a fifth lower, a tenth of the messages lost, up to 0.3 s late.
  static Disturbance usual() { return {0.10, 0.02, 0.30, 1.0, 2.0, 8.0, 0.20}; }
};

/// A vehicle that stops for ever and says nothing any more.
struct Death {
  std::string agv_id;
  double at_s{0.0};
};

struct TrafficRunSettings {
  Disturbance disturbance;
  std::vector<Death> deaths;
  std::string planner{"direct"};  // of the vehicles' own ways; empty: none, all drive by the roadmap
  std::uint64_t seed{1};
  double pause_s{0.5};                  // at a goal
  double restart_of_the_leader_s{0.0};  // it forgets everything then; 0: never
  std::function<void(double now_s, const global_planner::traffic::Coordinator&)> watch;  // once a second
  std::function<bool()> goes_on;  // asked once a second; false: the run ends there
};

/// How a run went.
struct TrafficRun {
  int goals{0};  // reached
  int goals_wanted{0};
  double last_goal_s{0.0};
  double duration_s{0.0};
  double driven_m{0.0};
  double own_way_share{0.0};  // of the metres
  int contacts{0}, wall_contacts{0}, off_road{0}, held_twice{0};
  double least_clearance_m{0.0};
  std::uint64_t refused{0}, circles{0};
  sim::LongestStand standoff, wait;
  double step_ms_p99{0.0}, step_ms_most{0.0}, all_steps_s{0.0};  // computing time of the coordinator
  std::vector<std::string> findings;
  std::vector<std::string> events;
  std::map<std::string, std::vector<double>> reached_s;  // of each vehicle, when it reached its goals
  double step_ms_mean{0.0};

  bool is_clean() const { return contacts + wall_contacts + off_road + held_twice == 0 && refused + circles == 0; }
  double goals_per_vehicle_hour(std::size_t vehicles) const {
    return 3600.0 * goals / (duration_s * static_cast<double>(vehicles));
  }
};

/// The kind of a scenario's vehicle, as the traffic sees it.
global_planner::traffic::Kind kind_of(const scenario::Vehicle& vehicle);

/// Runs the scenario with vehicles that follow their granted road exactly, the coordinator of the traffic, and a lossy
/// line between them. No scans, no tracker, no processes: only the traffic is judged.
///
/// The same seed gives the same run, but for the computing times.
class KinematicSite {
 public:
  KinematicSite(const scenario::Scenario& scenario, const TrafficRunSettings& settings);
  ~KinematicSite();

  /// Until all goals are reached, or the scenario's duration is over.
  TrafficRun run();

 private:
  struct Unit;
  struct Person;

  void place_vehicles();
  void place_people();
  global_planner::traffic::OwnWay own_way();

  void walk(double now_s);
  void edit_map(double now_s);
  void see_things(double now_s);
  void send_orders(double now_s);
  void deliver(double now_s);
  void drive(double now_s);
  void serve_goals(double now_s);
  void report(double now_s);
  void judge(double now_s);
  void restart_leader(double now_s);
  void send(double now_s, std::mt19937_64& random, bool is_repeated, std::function<void()> delivery);
  bool is_over() const;

  const scenario::Scenario& scenario_;
  TrafficRunSettings settings_;
  grid::OccupancyGrid grid_;
  grid::ClearanceField clearance_;
  FloorJudge judge_;
  sim::StandoffWatch standoffs_;
  std::unique_ptr<global_planner::traffic::Coordinator> coordinator_;
  std::map<std::string, std::unique_ptr<Unit>> units_;
  std::vector<std::unique_ptr<Person>> people_;
  std::vector<bool> block_is_seen_;
  std::multimap<double, std::function<void()>> underway_;  // by the time of arrival
  std::vector<double> step_ms_;
  double own_way_m_{0.0};
  std::size_t edits_done_{0};
  TrafficRun run_;
};

}  // namespace aisle::lab
