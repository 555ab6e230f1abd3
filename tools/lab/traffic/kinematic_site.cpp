#include "tools/lab/traffic/kinematic_site.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <deque>
#include <utility>

#include "common/geometry/separation.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/kinematics/vehicle_model.hpp"
#include "common/scenario/variation.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::lab {
namespace {

using geometry::Body;
using geometry::Point2;
using geometry::Pose2;
using global_planner::traffic::Capsule;
using global_planner::traffic::Coordinator;
using global_planner::traffic::GrantedRoad;
using global_planner::traffic::Kind;
using global_planner::traffic::Orders;
using global_planner::traffic::Shape;
using global_planner::traffic::Way;

constexpr double kTickS = 0.05;
constexpr int kTicksAReport = 2;
constexpr int kTicksAStep = 2;  // of the coordinator
constexpr int kTicksALook = 2;  // of the judge and of the watch on stand-offs
constexpr double kReachedM = 0.12;
constexpr double kSightM = 8.0;
constexpr double kStandsAfterS = 1.0;  // a person who stands so long is a thing on the floor
constexpr double kCourtesyM = 0.5;
constexpr std::size_t kRoadsKept = 4;

std::vector<Point2> granted_part(const Way& way, double limit_m) {
  std::vector<Point2> part;
  double along = 0.0;

  for (std::size_t i = 0; i < way.waypoints_in_map.size(); ++i) {
    if (i == 0) {
      part.push_back(way.waypoints_in_map.front());
      continue;
    }

    const Point2 from = way.waypoints_in_map[i - 1], to = way.waypoints_in_map[i];
    const double leg = geometry::distance(from, to);
    if (along + leg >= limit_m) {
      if (leg > 0.0 && limit_m > along) part.push_back(from + (limit_m - along) / leg * (to - from));
      break;
    }

    along += leg;
    part.push_back(to);
  }

  return part;
}

}  // namespace

Kind kind_of(const scenario::Vehicle& vehicle) {
  Kind kind;
  kind.footprint = vehicle.footprint();
  kind.limits.model = vehicle.kinematic_model();
  kind.limits.axle = vehicle.axle;
  kind.limits.max_speed_mps = vehicle.max_speed_mps;
  kind.turning_radius_m = 2.0 * kinematics::least_turning_radius_m(kind.limits);
  if (!kind.turns_on_the_spot()) kind.tube_m = 0.12;
  return kind;
}

/// A vehicle with its mission, and what was told to it.
struct KinematicSite::Unit {
  Unit(const scenario::Vehicle& setup, const Pose2& start_in_map, std::uint64_t seed)
      : vehicle(setup.id, kind_of(setup), start_in_map), random(scenario::random_for(seed, "traffic " + setup.id)) {}

  KinematicVehicle vehicle;
  std::mt19937_64 random;
  std::vector<Pose2> goals;
  std::size_t reached{0};
  bool is_told{false};       // of the goal that is next
  double idle_until_s{0.0};  // the pause at a goal
  double speed_share{1.0};
  double held_from_s{1e18}, held_until_s{0.0};
  double dies_at_s{1e18};

  std::map<std::uint64_t, Way> sent_ways;
  GrantedRoad sent;                                   // the newest grant
  std::deque<std::vector<Point2>> granted_roads;      // the last few
  std::vector<std::pair<std::uint64_t, bool>> steps;  // of the newest way: number, on its own way?

  bool has_open_goal() const { return reached < goals.size(); }
  bool is_dead(double now_s) const { return now_s >= dies_at_s; }
  bool is_held(double now_s) const { return now_s >= held_from_s && now_s < held_until_s; }
};

/// Somebody who walks along waypoints.
struct KinematicSite::Person {
  scenario::Mover mover;
  Point2 at_in_map;
  std::size_t next{1};
  bool is_back{false};
  double stands_since_s{0.0};
  bool is_known{false};  // as a thing that stands

  Body body() const {
    Body out;
    out.shape = Body::Shape::kDisc;
    out.base_in_map = {at_in_map.x, at_in_map.y, 0.0};
    out.radius_m = mover.radius_m;
    return out;
  }
};

KinematicSite::KinematicSite(const scenario::Scenario& scenario, const TrafficRunSettings& settings)
    : scenario_(scenario),
      settings_(settings),
      grid_(grid::read_map_file(scenario.map_file, scenario.map_options)),
      clearance_(grid_),
      judge_(clearance_) {
  place_vehicles();
  place_people();
  restart_leader(0.0);
}

KinematicSite::~KinematicSite() = default;

void KinematicSite::place_vehicles() {
  for (const scenario::Vehicle& setup : scenario_.vehicles) {
    const Pose2 start = scenario::varied_start(setup, scenario_.start_jitter_m, settings_.seed);
    auto unit = std::make_unique<Unit>(setup, start, settings_.seed);
    unit->granted_roads.push_back({start.position()});

    for (const scenario::Mission& mission : scenario_.missions)
      for (int loop = 0; mission.vehicle == setup.id && loop < mission.loops; ++loop)
        unit->goals.insert(unit->goals.end(), mission.goals_in_map.begin(), mission.goals_in_map.end());

    for (const Death& death : settings_.deaths)
      if (death.agv_id == setup.id) unit->dies_at_s = death.at_s;

    std::uniform_real_distribution<double> part(0.0, 1.0);
    unit->speed_share = 1.0 - settings_.disturbance.slower_by * part(unit->random);
    run_.goals_wanted += static_cast<int>(unit->goals.size());
    units_.emplace(setup.id, std::move(unit));
  }

  // Pairs that stand too near to each other from the beginning are no matter of the lock's.
  for (const auto& [id, a] : units_) {
    for (const auto& [other, b] : units_) {
      const Body body_a = geometry::body_of(a->vehicle.kind().footprint, a->vehicle.base_in_map());
      const Body body_b = geometry::body_of(b->vehicle.kind().footprint, b->vehicle.base_in_map());
      if (id < other && geometry::separation_m(body_a, body_b) < 0.25) judge_.except(id, other);
    }
  }
}

void KinematicSite::place_people() {
  for (const scenario::Mover& mover : scenario_.movers) {
    auto person = std::make_unique<Person>();
    person->mover = mover;
    person->at_in_map = mover.waypoints_in_map.front();
    people_.push_back(std::move(person));
  }

  block_is_seen_.assign(scenario_.blocks.size(), false);
}

global_planner::traffic::OwnWay KinematicSite::own_way() {
  const global_planner::Variant* variant = global_planner::find_variant(settings_.planner);
  if (variant == nullptr) return {};

  return [this, planner = std::shared_ptr<global_planner::Planner>(variant->make())](const std::string& agv_id,
                                                                                     Point2 from, Point2 to) {
    const Kind& kind = units_.at(agv_id)->vehicle.kind();
    if (!kind.turns_on_the_spot()) return std::vector<Point2>{};

    const double radius = geometry::reach_m(kind.footprint);
    global_planner::Problem problem{clearance_, from, to, radius + kind.wall_margin_m};
    problem.least_radius_m = radius;
    return planner->plan(problem, {}).waypoints_in_map;
  };
}

/// The leader begins with nothing but the map and what it hears from now on.
void KinematicSite::restart_leader(double now_s) {
  coordinator_ = std::make_unique<Coordinator>(Coordinator::Settings{}, own_way());
  coordinator_->set_map(clearance_, {0, 0}, {clearance_.geometry().width - 1, clearance_.geometry().height - 1});

  for (const auto& [id, unit] : units_) {
    coordinator_->set_vehicle(id, unit->vehicle.kind());
    unit->is_told = unit->is_told && now_s <= 0.0;
  }
}

/// Puts a message on the line: it arrives late, or not at all; one that is repeated comes even later instead.
void KinematicSite::send(double now_s, std::mt19937_64& random, bool is_repeated, std::function<void()> delivery) {
  const Disturbance& disturbance = settings_.disturbance;
  std::uniform_real_distribution<double> delay(disturbance.least_delay_s, disturbance.most_delay_s);
  std::bernoulli_distribution is_lost(disturbance.loss);
  double at_s = now_s + delay(random);

  while (is_lost(random)) {
    if (!is_repeated) return;
    at_s += 0.2;
  }

  underway_.emplace(at_s, std::move(delivery));
}

void KinematicSite::deliver(double now_s) {
  while (!underway_.empty() && underway_.begin()->first <= now_s) {
    const std::function<void()> delivery = std::move(underway_.begin()->second);
    underway_.erase(underway_.begin());
    delivery();
  }
}

void KinematicSite::walk(double now_s) {
  for (const auto& person : people_) {
    const scenario::Mover& mover = person->mover;
    const bool is_at_end = person->next >= mover.waypoints_in_map.size();
    if (now_s < mover.start_s || (is_at_end && !mover.loop)) continue;

    const std::vector<Point2>& points = mover.waypoints_in_map;
    const std::size_t count = points.size();
    const std::size_t target = is_at_end ? 0 : person->next;
    const Point2 to = points[target];
    const double left = geometry::distance(person->at_in_map, to);
    const double step = std::min(left, mover.speed_mps * kTickS);
    const Point2 at = left > 1e-9 ? person->at_in_map + step / left * (to - person->at_in_map) : to;

    bool is_in_way = false;
    for (const auto& [id, unit] : units_) {
      Body next = person->body();
      next.base_in_map = {at.x, at.y, 0.0};
      const Body vehicle = geometry::body_of(unit->vehicle.kind().footprint, unit->vehicle.base_in_map());
      const bool is_nearer = geometry::distance(at, vehicle.base_in_map.position()) <
                             geometry::distance(person->at_in_map, vehicle.base_in_map.position());
      if (mover.courteous && is_nearer && geometry::separation_m(next, vehicle) < kCourtesyM) is_in_way = true;
    }

    if (is_in_way) continue;
    if (step > 0.0) person->stands_since_s = now_s;

    person->at_in_map = at;
    if (left - step < 1e-9) person->next = is_at_end ? 1 : person->next + 1;
    if (person->next >= count && !mover.loop) person->stands_since_s = now_s;
  }
}

void KinematicSite::edit_map(double now_s) {
  while (edits_done_ < scenario_.map_edits.size() && scenario_.map_edits[edits_done_].at_s <= now_s) {
    const scenario::MapEdit& edit = scenario_.map_edits[edits_done_++];
    const grid::Cell low = grid_.geometry().cell_at(edit.low_in_map);
    const grid::Cell high = grid_.geometry().cell_at(edit.high_in_map);

    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        if (grid_.geometry().contains({x, y}))
          grid_.set({x, y}, edit.block ? grid::Occupancy::kOccupied : grid::Occupancy::kFree);

    clearance_.update(grid_, low, high);
    coordinator_->set_map(clearance_, low, high);
  }
}

/// What a tracker would tell: persons that stand, and blocks, as soon as a vehicle is near.
void KinematicSite::see_things(double now_s) {
  const auto is_seen = [&](Point2 at) {
    return std::any_of(units_.begin(), units_.end(), [&](const auto& unit) {
      return geometry::distance(unit.second->vehicle.base_in_map().position(), at) < kSightM;
    });
  };

  for (const auto& person : people_) {
    const bool stands = now_s - person->stands_since_s > kStandsAfterS;
    if (stands == person->is_known || !is_seen(person->at_in_map)) continue;

    person->is_known = stands;
    const Shape disc({Capsule{person->at_in_map, person->at_in_map, person->mover.radius_m + 0.1}});
    coordinator_->set_standing(person->mover.id, stands ? disc : Shape(), now_s);
  }

  for (std::size_t i = 0; i < scenario_.blocks.size(); ++i) {
    const scenario::Block& block = scenario_.blocks[i];
    if (block_is_seen_[i] || now_s < block.appear_s || !is_seen(block.center_in_map.position())) continue;

    const double half = 0.5 * std::max(0.0, block.length_m - block.width_m);
    block_is_seen_[i] = true;
    coordinator_->set_standing(block.id,
                               Shape({Capsule{geometry::to_map(block.center_in_map, {-half, 0.0}),
                                              geometry::to_map(block.center_in_map, {half, 0.0}),
                                              0.5 * std::hypot(block.width_m, block.width_m)}}),
                               now_s);
  }
}

/// Lets the coordinator work, and sends what it says.
void KinematicSite::send_orders(double now_s) {
  int slices = 0;

  do {
    const std::clock_t begin = std::clock();
    const Orders orders = coordinator_->step(now_s);
    step_ms_.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);

    for (const Way& way : orders.ways) {
      Unit& unit = *units_.at(way.agv_id);
      unit.sent_ways[way.plan_id] = way;
      while (unit.sent_ways.size() > 8) unit.sent_ways.erase(unit.sent_ways.begin());
      send(now_s, unit.random, true, [&unit, way, now_s] {
        if (!unit.is_dead(now_s)) unit.vehicle.hear(way);
      });
    }

    for (const GrantedRoad& grant : orders.grants) {
      Unit& unit = *units_.at(grant.agv_id);
      unit.sent = grant;
      const auto way = unit.sent_ways.find(grant.plan_id);
      if (way != unit.sent_ways.end()) unit.granted_roads.push_back(granted_part(way->second, grant.limit_m));
      if (unit.granted_roads.size() > kRoadsKept) unit.granted_roads.pop_front();
      send(now_s, unit.random, true, [&unit, grant] { unit.vehicle.hear(grant); });
    }

    run_.events.insert(run_.events.end(), orders.events.begin(), orders.events.end());
  } while (coordinator_->is_busy() && ++slices < 10);
}

void KinematicSite::report(double now_s) {
  for (const auto& entry : units_) {
    Unit& unit = *entry.second;
    if (unit.is_dead(now_s)) continue;

    send(now_s, unit.random, false, [this, said = unit.vehicle.report(), now_s] { coordinator_->hear(said, now_s); });
  }
}

void KinematicSite::drive(double now_s) {
  std::vector<Body> in_sight;
  for (const auto& person : people_) in_sight.push_back(person->body());
  for (const scenario::Block& block : scenario_.blocks)
    if (now_s >= block.appear_s)
      in_sight.push_back({Body::Shape::kRectangle, block.center_in_map, 0.0, block.length_m, block.width_m});

  const double hold_chance = settings_.disturbance.holds_a_minute * kTickS / 60.0;
  for (const auto& entry : units_) {
    Unit& unit = *entry.second;
    if (unit.is_dead(now_s)) continue;

    if (hold_chance > 0.0 && now_s >= unit.held_until_s && std::bernoulli_distribution(hold_chance)(unit.random)) {
      std::uniform_real_distribution<double> length(settings_.disturbance.least_hold_s,
                                                    settings_.disturbance.most_hold_s);
      unit.held_from_s = now_s;
      unit.held_until_s = now_s + length(unit.random);
    }

    const double before_m = unit.vehicle.driven_m();
    unit.vehicle.drive(kTickS, unit.speed_share, unit.is_held(now_s), in_sight);

    const double moved_m = unit.vehicle.driven_m() - before_m;
    run_.driven_m += moved_m;
    if (moved_m > 0.0 && coordinator_->is_on_own_way(unit.vehicle.id(), unit.vehicle.step())) own_way_m_ += moved_m;
  }
}

/// Gives the goals out, one after the other.
void KinematicSite::serve_goals(double now_s) {
  for (const auto& [id, unit] : units_) {
    if (!unit->has_open_goal() || unit->is_dead(now_s) || now_s < unit->idle_until_s) continue;

    const Pose2& goal = unit->goals[unit->reached];
    const std::string goal_id = id + "/" + std::to_string(unit->reached);
    if (!unit->is_told) {
      unit->is_told = true;
      coordinator_->set_goal(id, goal_id, goal, now_s);
    }

    const bool stands = unit->vehicle.speed_mps() < 0.01;
    if (!stands || geometry::distance(unit->vehicle.base_in_map().position(), goal.position()) > kReachedM) continue;

    ++unit->reached;
    ++run_.goals;
    run_.last_goal_s = now_s;
    run_.reached_s[id].push_back(now_s);
    unit->is_told = false;
    unit->idle_until_s = now_s + settings_.pause_s;
    coordinator_->set_goal(id, "", std::nullopt, now_s);
  }
}

void KinematicSite::judge(double now_s) {
  std::vector<JudgedVehicle> judged;
  std::map<std::string, sim::Doing> doings;

  for (const auto& [id, unit] : units_) {
    const KinematicVehicle& vehicle = unit->vehicle;
    JudgedVehicle one{id, vehicle.kind().footprint, vehicle.base_in_map(), !unit->is_dead(now_s), {}, {}};
    one.roads_in_map.push_back(vehicle.road_ahead_in_map());
    one.granted_in_map.assign(unit->granted_roads.begin(), unit->granted_roads.end());
    judged.push_back(std::move(one));

    const bool is_at_work = now_s < unit->idle_until_s;
    const bool is_moving = (vehicle.speed_mps() > 0.01 || vehicle.is_turning()) && !unit->is_dead(now_s);
    doings[id] = {unit->has_open_goal() && !is_at_work && !unit->is_dead(now_s), is_moving,
                  is_at_work || unit->is_held(now_s) || unit->is_dead(now_s) || vehicle.is_blocked(),
                  vehicle.newest_grant().waits_for, vehicle.newest_grant().reason};
  }

  judge_.look(now_s, judged);
  standoffs_.look(now_s, doings);
}

bool KinematicSite::is_over() const {
  return std::none_of(units_.begin(), units_.end(), [](const auto& unit) { return unit.second->has_open_goal(); });
}

TrafficRun KinematicSite::run() {
  const int ticks = static_cast<int>(std::ceil(scenario_.duration_s / kTickS));
  int tick = 0;

  for (; tick < ticks && !is_over(); ++tick) {
    const double now_s = tick * kTickS;
    const bool restarts =
        settings_.restart_of_the_leader_s > 0.0 && std::abs(now_s - settings_.restart_of_the_leader_s) < 0.5 * kTickS;
    if (restarts) restart_leader(now_s);

    walk(now_s);
    edit_map(now_s);
    see_things(now_s);
    deliver(now_s);
    drive(now_s);
    serve_goals(now_s);

    if (tick % kTicksAReport == 0) report(now_s);
    if (tick % kTicksAStep == 0) send_orders(now_s);
    if (tick % kTicksALook == 0) judge(now_s);
    if (settings_.watch && tick % 20 == 0) settings_.watch(now_s, *coordinator_);
    if (settings_.goes_on && tick % 20 == 0 && !settings_.goes_on()) break;
  }

  run_.duration_s = tick * kTickS;
  run_.own_way_share = run_.driven_m > 0.0 ? own_way_m_ / run_.driven_m : 0.0;
  run_.contacts = judge_.contacts();
  run_.wall_contacts = judge_.wall_contacts();
  run_.off_road = judge_.off_road();
  run_.held_twice = judge_.held_twice();
  run_.least_clearance_m = judge_.least_clearance_m();
  run_.findings = judge_.findings();
  run_.refused = coordinator_->refused();
  run_.circles = coordinator_->circles();
  run_.standoff = standoffs_.longest_standoff();
  run_.wait = standoffs_.longest_wait();

  std::sort(step_ms_.begin(), step_ms_.end());
  for (const double ms : step_ms_) run_.all_steps_s += 1e-3 * ms;
  if (!step_ms_.empty()) {
    run_.step_ms_p99 = step_ms_[step_ms_.size() * 99 / 100];
    run_.step_ms_most = step_ms_.back();
    run_.step_ms_mean = 1e3 * run_.all_steps_s / static_cast<double>(step_ms_.size());
  }

  return run_;
}

}  // namespace aisle::lab
