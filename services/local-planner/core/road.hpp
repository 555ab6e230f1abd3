#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "services/local-planner/core/lane.hpp"
#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/route.hpp"

namespace aisle::local_planner {

/// The steps of the plan in force: how far the vehicle has come along them, and how far it may drive.
///
///   plan ──► steps ── grant ──► limit: the end of the last step that may be driven
///                  ── where the vehicle is ──► progress, steps done
///
/// A limit lies at the end of a step. It is raised at once. A lower one is taken as low as the vehicle can stop at with
/// comfortable braking, and lower still once it can; the report says which that is. A vehicle that is asked for the
/// step that it is on brakes, and stays where it then stands. Lengths are along the plan's polyline, from its first
/// point; numbers of steps are absolute.
///
/// A plan without steps has no limit: then nothing here has an effect.
class Road {
 public:
  Road(const LaneSettings& lane, double comfort_mps2) : lane_settings_(lane), comfort_mps2_(comfort_mps2) {}

  /// Takes up plan and grant of this cycle's inputs, and where the vehicle is. A plan that was not found or was
  /// cancelled leaves the road as it was: the vehicle still stands on it.
  /// @param speed_mps that is in force
  /// @pre the vehicle and its state are known
  void follow(const Moment& moment, double speed_mps);

  bool has_steps() const { return !step_ends_m_.empty(); }

  /// Half of the width that the vehicle keeps to; 0: all the free floor.
  double tube_m() const { return has_steps() ? tube_m_ : 0.0; }

  /// The plan's way as a lane for the tube: its polyline, with an arc at each turn as far as the steps that it runs in
  /// are granted, and as there is room at the walls. An arc that was begun stays.
  Lane lane() const;

  /// Counts up whenever that lane changes.
  std::uint64_t lane_revision() const { return lane_revision_; }

  /// Along the plan.
  double progress_m() const { return progress_m_; }

  /// The same, where it is at least: at the end of the steps that it has done, which may be told a tube's half width
  /// before.
  double least_m() const { return std::max(0.0, end_of_steps_below_m(step_done_) - tube_m()); }

  /// Has it done all the steps that it may drive?
  bool is_driven() const { return has_steps() && step_done_ >= limit_step_; }

  /// The plan's polyline.
  const Route& way() const { return way_; }

  /// The vehicle must not pass this point of the plan; infinity: it has no limit, or it is the goal, where it stops by
  /// itself.
  double stop_at_m() const;

  /// The next turn that is driven to before it is left: it has no arc, and is too sharp to be cut. Infinity: none.
  double gate_m() const;

  /// Where it is and how far it may drive, for the leader of the traffic; without how far it strays.
  RoadReport report(const Moment& moment) const;

 private:
  /// A point of the plan where it turns or where a step ends.
  struct Turn {
    double at_m{0.0};
    geometry::Point2 in_map;
    double by_rad{0.0};       // to either side
    double leg_m{0.0};        // the shorter one of the two that meet here
    std::uint64_t step{0};    // that leads here
    double arc_m{0.0};        // from the arc's begin to the turn; 0: no arc
    bool was_reached{false};  // by the vehicle, in the middle
  };

  void take(const Plan& plan, geometry::Point2 here_in_map);
  double progress_on(const Plan& plan, const Route& way, geometry::Point2 here_in_map) const;
  void find_turns();
  void obey(const Grant& grant);
  bool give_back(double speed_mps);
  bool take_more();
  void move_on(const Moment& moment);

  /// Which turn is the next gate; beyond the last: there is none.
  std::size_t next_gate() const;

  /// Rounds all turns that were not begun, as far as is granted.
  void round_turns(const Moment& moment);
  double arc_at(const Turn& turn, const Moment& moment) const;

  std::uint64_t end_step() const { return first_step_ + step_ends_m_.size(); }

  /// Along the plan, to where the steps below this one end.
  double end_of_steps_below_m(std::uint64_t step) const;
  double limit_m() const { return end_of_steps_below_m(limit_step_); }

  std::uint64_t lowest_limit(double speed_mps) const;
  bool is_on_arc_into_next_step() const;
  std::uint64_t most_told(std::uint64_t limit_step) const;
  bool stands_at_end_of(std::uint64_t step, const Moment& moment) const;
  std::vector<HeldPose> held(const Moment& moment) const;

  LaneSettings lane_settings_;
  double comfort_mps2_;

  // The plan.
  std::uint64_t plan_id_{0};
  std::vector<geometry::Point2> waypoints_in_map_;
  Route way_;  // its polyline, as it is
  std::uint64_t first_step_{0};
  std::vector<double> step_ends_m_;
  double tube_m_{0.0};
  bool ends_at_goal_{false};
  std::vector<Turn> turns_;  // first and last point included

  // The vehicle on it.
  double progress_m_{0.0};
  std::uint64_t step_done_{0};
  std::uint64_t limit_step_{0};         // that it stops at
  std::uint64_t wanted_limit_step_{0};  // of the grant that it obeys, as far as it can be told
  std::uint64_t granted_step_{0};       // all of it
  std::uint64_t grant_number_{0};
  std::uint64_t lane_revision_{0};
};

}  // namespace aisle::local_planner
