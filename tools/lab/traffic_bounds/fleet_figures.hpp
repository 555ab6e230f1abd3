#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/lab/traffic_bounds/joint_plans.hpp"

namespace aisle::lab {

/// The longest of its kind, with the vehicle's own words for it.
struct StandFigures {
  double seconds{0.0};
  std::string cause;  // empty: there was none
};

/// What a fleet with more goals than it can reach came to.
struct ReachedFigures {
  int goals{0};
  double goals_per_vehicle_hour{0.0};
  double time_to_alone{1.0};  // sum of times of each vehicle's last goal, to the same goals in its free run
  int least_served{0};        // goals of the vehicle with the fewest, and with the most
  int most_served{0};
  double own_way_share{0.0};  // of the metres
  StandFigures standoff, wait;
  int findings{0};  // contacts, floor held twice, refusals of the lock, circles: 0, or there is a fault
  std::string first_finding;
  double step_ms_mean{0.0}, step_ms_p99{0.0};  // computing time of a cycle of the planner; 0: not measured
};

/// Each vehicle to one goal, beside the free runs and beside a multi-agent plan without delays.
struct OneShotFigures {
  int goals{0};                  // reached, by the fleet and alone
  double makespan_s{0.0};        // until the last one is there
  double alone_makespan_s{0.0};  // of the slowest free run
  double ends_s{0.0};            // sum of times
  double alone_ends_s{0.0};      // the same of the free runs
  std::uint64_t plan_cost{0};    // of the multi-agent plan in unit steps; 0: it found none
  std::uint64_t plan_least_cost{0};

  double stretch() const { return alone_ends_s > 0.0 ? ends_s / alone_ends_s : 1.0; }
  double plan_stretch() const {
    return plan_least_cost > 0 ? static_cast<double>(plan_cost) / static_cast<double>(plan_least_cost) : 1.0;
  }

  /// None where a goal was missed, or where there is no plan to compare with.
  std::optional<double> ratio(std::size_t vehicles) const {
    if (plan_cost == 0 || goals < static_cast<int>(vehicles)) return std::nullopt;
    return stretch() / plan_stretch();
  }
};

/// A fleet of one size on one floor. Rates are goals a vehicle and hour.
struct FleetRow {
  std::size_t vehicles{0};
  double steps_a_goal{0.0};     // S_N of plain PIBT
  double bound{0.0};            // the PIBT bound
  double roadmap_bound{0.0};    // the same with seconds a step of vehicles that drive by the roadmap only
  std::optional<double> alone;  // mean of the free runs
  std::optional<ReachedFigures> reached;
  std::optional<OneShotFigures> one_shot;
  std::optional<ReachedFigures> site;  // the simulated site with all services
  std::optional<double> site_bound;    // with seconds a step of its own free runs
  JointPlans plans;
};

/// All fleets of one floor.
struct FloorFigures {
  std::string floor;
  std::size_t places{0};
  double step_s{0.0};          // tau, of free runs on own ways
  double roadmap_step_s{0.0};  // of free runs by the roadmap
  std::optional<double> site_step_s;
  std::vector<FleetRow> rows;
};

}  // namespace aisle::lab
