#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "services/global-planner/core/traffic/joint_plan.hpp"
#include "services/global-planner/core/traffic/lock.hpp"

namespace aisle::global_planner::traffic {

/// A place on the road that a vehicle still has, and the number of the step that it belongs to.
struct HeldPose {
  geometry::Pose2 base_in_map;
  std::uint64_t step{0};
};

/// What a vehicle says of its progress (from navigation_status and vehicle_state).
struct Report {
  std::string agv_id;
  geometry::Pose2 base_in_map;
  double speed_mps{0.0};
  std::uint64_t plan_id{0};       // that it drives
  std::uint64_t step_done{0};     // steps behind it, in absolute numbers
  std::uint64_t limit_step{0};    // first step that it will not drive: it stops at the end of the one before at the
                                  // latest; equal to step_done while it stands within a step: it stays where it is
  std::uint64_t boot_id{0};       // of its local planner, which counts the steps
  std::uint64_t grant_number{0};  // that it obeys
  bool is_others_grant{false};    // another leader gave it: its number answers nothing that this one asked
  double stray_m{0.0};            // of its outline, off the path
  bool is_held{false};            // by a person
  bool is_blocked{false};         // by something that it sees in its tube; stands there
  geometry::Point2 blocked_at_in_map;
  double blocked_radius_m{0.0};
  std::vector<HeldPose> held;  // its path from where it is to its limit: a leader that has forgotten all needs it
};

/// A way to drive, as far as it is planned: the turning points, where each step ends along it, and its number.
struct Way {
  std::string agv_id;
  std::uint64_t plan_id{0};
  std::uint64_t first_step{0};  // number of the step that begins at the first point
  std::vector<geometry::Point2> waypoints_in_map;
  std::vector<double> headings_rad;     // at each point, for kinds that do not turn on the spot
  std::vector<double> step_ends_m;      // along the way, of first_step, first_step + 1, ...
  std::vector<std::uint8_t> own_steps;  // of each step: 1 where it is one of the vehicle's own way
  bool leads_to_goal{false};
  std::string goal_id;         // that the vehicle had when the way was made; empty: it is moved out of the way
  std::string own_or_roadmap;  // "own way", "roadmap", or "own way, roadmap"
  double tube_m{0.0};          // beside the vehicle's outline; 0: as wide as the free floor, it is alone
};

/// How far a vehicle may drive on which plan.
struct GrantedRoad {
  std::string agv_id;
  std::uint64_t number{0};
  std::uint64_t plan_id{0};
  std::uint64_t limit_step{0};  // it may drive to the end of the step before this number: steps below it are granted
  double limit_m{0.0};          // the same along the plan
  bool gives_back{false};       // asks to give back what lies beyond limit_step
  std::vector<std::string> waits_for;
  std::string reason;
};

/// What a step of the coordinator comes to: only what changed.
struct Orders {
  std::vector<Way> ways;
  std::vector<GrantedRoad> grants;
  std::vector<std::string> events;  // for the log
};

/// The vehicle's own way from here to there by the planner chosen for it; empty: none.
using OwnWay = std::function<std::vector<geometry::Point2>(const std::string& agv_id, geometry::Point2 from_in_map,
                                                           geometry::Point2 to_in_map)>;

/// Decides when is planned for whom, and grants road. Pure: time comes in as seconds, orders go out.
///
///   goals, reports, map, things that stand ─► closures ─► plans of those without (own way, roadmap, group, all)
///                                                      ─► retiming ─► grants: links done, lock admits ─► orders
class Coordinator {
 public:
  struct Settings {
    double gap_m{0.05};
    double tube_m{0.10};
    double silent_s{2.0};
    double latency_s{0.3};
    double least_ahead_m{4.0};
    std::size_t most_steps_ahead{30};
  };

  Coordinator(const Settings& settings, OwnWay own_way);

  void set_map(const grid::ClearanceField& clearance, grid::Cell low, grid::Cell high);

  /// See Roadmap. A change of zones acts like an edit of the map: plans through them are made anew, and whoever is
  /// inside may leave.
  void set_zones(const std::vector<fleet::Zone>& zones, double now_s);
  void set_bare_map(const grid::OccupancyGrid* map) { roadmap_.set_bare_map(map); }
  void set_vehicle(const std::string& agv_id, const Kind& kind);

  /// A vehicle of which others speak takes part, though its build is not known yet: until it was heard, or signed off,
  /// it may hold any floor, and nothing is granted.
  void expect(const std::string& agv_id);

  /// The newest pose of the vehicle; makes it a part of the traffic once its kind and the map are known.
  void hear(const Report& report, double now_s);

  /// @param goal_in_map none: it has no goal (any more)
  void set_goal(const std::string& agv_id, const std::string& goal_id,
                const std::optional<geometry::Pose2>& goal_in_map, double now_s);

  /// Something that stands on the floor and is in no map; an empty shape ends it.
  void set_standing(const std::string& name, const Shape& shape, double now_s);

  /// A person says that the vehicle, which is not heard, drives no more: nobody waits for its word. It goes on holding
  /// all that it may still drive, unless the person says where it stands. Ends when it is heard again. A vehicle that
  /// is heard cannot be signed off.
  /// @param place_in_map where the person sees it: that is all that it holds
  /// @param last_word of a vehicle that this leader never heard; none, and no place: it leaves the traffic
  void sign_off(const std::string& agv_id, const std::optional<geometry::Point2>& place_in_map,
                const std::optional<Report>& last_word, double now_s);

  /// Works for one slice; call it again at once while `is_busy()`.
  Orders step(double now_s);
  bool is_busy() const { return is_busy_; }

  std::uint64_t refused() const { return refused_; }  // motions that the lock refused though their links were done: 0
  std::uint64_t circles() const { return plans_.circles(); }

  /// A number for a plan of the vehicle that is not the coordinator's: one without a way. Later ways have higher ones.
  /// 0: the vehicle is not known.
  std::uint64_t take_plan_id(const std::string& agv_id);

  /// Is the step of the vehicle one of its own way? False for a step that is unknown.
  bool is_on_own_way(const std::string& agv_id, std::uint64_t step) const;

  /// For pictures, statistics and tests.
  const JointPlan& plans() const { return plans_; }
  const Roadmap& roadmap() const { return roadmap_; }
  const Lock& lock() const { return lock_; }

 private:
  /// Road that the vehicle may drive before the first step of its agent: what it still had when this leader first
  /// heard it, or its way out of a spot too near to another. The agent counts as if it stood at the end of it.
  struct LeadIn {
    std::vector<geometry::Point2> path_in_map;
    std::vector<double> headings_rad;
    std::vector<double> step_ends_m;  // along the path, of first_step, first_step + 1, ...
    std::uint64_t first_step{0};
  };

  struct AskedBack {
    std::uint64_t limit_step{0};
    std::uint64_t number{0};  // of the grant that asks; 0: not sent yet
  };

  struct VehicleEntry {
    std::string id;
    Kind kind;
    KindId kind_id{0};
    Report said;
    double heard_s{0.0};
    bool is_heard{false};
    bool is_registered{false};
    bool is_silent{false};
    bool is_signed_off{false};
    double blocked_since_s{-1.0};
    double blocked_until_s{-1.0};  // the closure that its word made ends then; negative: there is none
    double registering_s{-1e9};    // last try

    std::string goal_id;
    std::optional<geometry::Pose2> goal_in_map;
    double goal_since_s{0.0};
    double tried_s{-1e9};        // last search for a plan
    double without_plan_s{0.0};  // since when
    int tries{0};                // of searches for this goal, in vain
    double own_tried_s{-1e9};

    LeadIn lead_in;
    std::optional<LeadIn> behind;  // the step behind it: it may be on the arc that leads out of it
    bool is_behind_own{false};     // that step was one of its own way
    std::optional<AskedBack> asked_back;
    double asked_back_s{-1e9};                      // when it was asked last
    double closed_since_s{-1.0};                    // floor that is granted to it; negative: it is open
    std::uint64_t refused_step{~std::uint64_t{0}};  // counted already
    std::set<std::string> excepted;                 // too near to these from the beginning

    Way way;                     // as sent
    std::vector<MotionId> sent;  // motions of its steps after the lead-in
    GrantedRoad told;            // as sent
    std::uint64_t next_plan_id{1};
    std::uint64_t next_grant{1};
    std::vector<std::string> waits_for;
    std::string reason;
    bool is_off_road{false};            // its body is held as it is
    double off_road_s{0.0};             // since when
    double asked_around_s{-1e9};        // road of others that meets its body was asked for last
    std::uint64_t newest_wide_plan{0};  // that it was told without a tube; 0: none
  };

  static constexpr double kMostTriesSaved = 60'000.0;  // of tries_expanded_

  void grow_budgets(double now_s);
  void improve(double now_s);
  void plans_changed();

  // coordinator_vehicles.cpp: registration, strays, silence
  void register_vehicle(VehicleEntry& vehicle, double now_s);
  void place_agent(VehicleEntry& vehicle, PlaceId place, std::uint64_t step, double now_s);
  void take_in_anew(VehicleEntry& vehicle, double now_s);
  bool has_forgotten_its_road(const VehicleEntry& vehicle, const Report& report) const;
  void hear_again(VehicleEntry& vehicle, double now_s);
  void hear_restarted(VehicleEntry& vehicle, const Report& report, double now_s);
  void remove_vehicle(VehicleEntry& vehicle);
  void stand_at(VehicleEntry& vehicle, geometry::Point2 place_in_map, double now_s);
  void ask_back_around(const VehicleEntry& newcomer, const Shape& body, double now_s);
  bool escape(VehicleEntry& vehicle, double now_s);
  bool is_alone() const { return vehicles_.size() + expected_.size() <= 1; }
  void hear_progress(VehicleEntry& vehicle, double now_s);
  void hear_answer(VehicleEntry& vehicle, double now_s);
  void look_for_silence(double now_s);
  void rebase(VehicleEntry& vehicle, double now_s);
  void part_near_ones(double now_s);
  void end_exceptions(VehicleEntry& vehicle);

  // coordinator_strays.cpp: bodies off their road, and tubes
  bool is_off_road(const VehicleEntry& vehicle) const;
  void look_for_strays(double now_s);
  void hold_body(VehicleEntry& vehicle, double now_s);
  Shape floor_of_lead_in(const VehicleEntry& vehicle) const;
  bool may_be_wide(const VehicleEntry& vehicle) const;
  std::string wide_one() const;
  double tube_m(const VehicleEntry& vehicle) const { return is_alone() ? 0.0 : vehicle.kind.tube_m; }

  // coordinator_closures.cpp: floor that is closed, and taking back
  void close(const std::string& name, const Shape& shape, double now_s);
  void open(const std::string& name);
  void leave_closed_floor(double now_s);
  void look_for_blocks(double now_s);
  bool may_ask_back(const VehicleEntry& vehicle, const Motion& motion, double now_s) const;
  bool has_way_round(VehicleEntry& vehicle, double now_s);
  void ask_back(VehicleEntry& vehicle, std::uint64_t limit_step, double now_s);
  bool is_open(MotionId motion) const;

  // coordinator_plans.cpp: who is planned when
  void plan_those_without(double now_s);
  bool plan_one(VehicleEntry& vehicle, double now_s);
  double retry_at_s(const VehicleEntry& vehicle) const;
  void set_agent_goal(VehicleEntry& vehicle, double now_s);
  void move_resters(double now_s);
  void retry_own_way(double now_s);
  std::vector<MotionId> own_way_motions(const VehicleEntry& vehicle);
  PlaceId goal_place(const VehicleEntry& vehicle);
  PlaceId end_of_grants(const Agent& agent) const;
  void sweep(double now_s);

  // coordinator_grants.cpp: grants and orders
  void grant_all();
  std::string unheard() const;
  bool grant_next(VehicleEntry& vehicle);
  bool makes_way(const Agent& agent) const;
  bool wants_road(const VehicleEntry& vehicle, const Agent& agent) const;
  void hold_end_of_grants(VehicleEntry& vehicle);
  void tell_reasons(VehicleEntry& vehicle);
  void tell_way(VehicleEntry& vehicle, Orders& orders);
  void tell_grant(VehicleEntry& vehicle, bool is_new_way, Orders& orders);
  Way way_of(const VehicleEntry& vehicle, const Agent& agent) const;
  double limit_on_way_m(const VehicleEntry& vehicle, std::uint64_t limit_step) const;

  Settings settings_;
  OwnWay own_way_;
  Roadmap roadmap_;
  Lock lock_;
  JointPlan plans_;
  std::map<std::string, VehicleEntry> vehicles_;
  std::set<std::string> expected_;  // vehicles whose build is not known yet
  std::vector<std::string> events_;
  bool has_map_{false};
  bool is_busy_{false};
  bool has_changed_{false};  // something that plans may have to leave
  std::uint64_t refused_{0};
  std::uint64_t random_state_{1};
  double improve_every_s_{0.1};
  double retimed_s_{-1e9};
  double improved_s_{-1e9};
  double improve_expanded_{0.0};  // states that improvement may expand: grows with time
  double swept_s_{-1e9};
  double budgets_grown_s_{-1e9};
  double tries_expanded_{0.0};  // states that groups and further tries may expand: grows with time
  double newest_goal_s_{-1e9};  // when any vehicle was given its goal last
  bool is_settling_{false};     // that was a moment ago
};

}  // namespace aisle::global_planner::traffic
