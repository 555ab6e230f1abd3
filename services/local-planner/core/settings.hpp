#pragma once

#include "services/local-planner/core/dwa.hpp"
#include "services/local-planner/core/lane.hpp"
#include "services/local-planner/core/surroundings.hpp"

namespace aisle::local_planner {

/// Everything that a site may set, with its default, unit and bounds.
struct Settings {
  double control_period_s{0.02};
  double stale_state_s{0.2};    // older: stop
  double stale_tracker_s{0.5};  // silent for longer: stop
  double late_s{0.15};          // a cycle that comes so long after the one before is late: stop,
  double late_hold_s{0.5};      // and stand for so long after the last late one
  double plan_update_s{0.5};    // a plan of an older map revision is driven slowly for so long, then not
  double cautious_mps{0.3};     // speed meanwhile
  double blocked_after_s{3.0};  // standing before something for so long: say so, and ask for a new plan
  double comfort_mps2{0.6};     // braking before bends, goals and where the granted road ends
  bool slows_on_the_way{true};  // before bends and near walls; false: as the papers drive, by the dynamic window alone
  bool as_printed{false};       // the variant as its paper prints it, with nothing of ours in between
  LaneSettings lane;
  DwaSettings dwa;
  SurroundingsSettings surroundings;

  template <class Reader>
  void describe(Reader& r) {
    r.field("stale_state_s", stale_state_s, 0.05, 2.0)
        .field("stale_tracker_s", stale_tracker_s, 0.1, 5.0)
        .field("late_s", late_s, 0.05, 2.0)
        .field("late_hold_s", late_hold_s, 0.0, 10.0)
        .field("plan_update_s", plan_update_s, 0.0, 5.0)
        .field("cautious_mps", cautious_mps, 0.0, 2.0)
        .field("blocked_after_s", blocked_after_s, 0.5, 60.0)
        .field("comfort_mps2", comfort_mps2, 0.1, 5.0)
        .field("lane_margin_m", lane.margin_m, 0.0, 1.0)
        .field("wall_margin_m", dwa.wall_margin_m, 0.0, 1.0)
        .field("peer_margin_m", dwa.peer_margin_m, 0.0, 1.0)
        .field("person_margin_m", surroundings.mover_margin_m, 0.0, 1.0)
        .field("horizon_s", dwa.horizon_s, 0.5, 5.0)
        .field("linear_samples", dwa.linear_samples, 2, 50)
        .field("angular_samples", dwa.angular_samples, 3, 101)
        .field("dead_time_s", surroundings.dead_time_s, 0.0, 1.0)
        .field("track_latency_s", surroundings.track_latency_s, 0.0, 1.0);
  }
};

}  // namespace aisle::local_planner
