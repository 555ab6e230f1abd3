#include <algorithm>
#include <map>

#include "common/kinematics/vehicle_model.hpp"
#include "services/fake-world/core/world.hpp"
#include "tools/lab/tracking/scene.hpp"
#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/site.hpp"

namespace aisle::tracking {
namespace {

using geometry::Body;
using geometry::Pose2;

constexpr double kPeriod_s = 0.1;  // of the snapshots

/// Vehicles as the simulated site drove them; people and blocks move on around them as in the scenario.
class DrivenScenario final : public Scene {
 public:
  DrivenScenario(const sim::Setup& setup, int vehicles)
      : setup_(setup), world_(setup.scenario, setup.people, setup.seed, nullptr) {
    sim::Setup drive = setup;
    drive.perception = sim::Perception::kTruth;
    sim::Hooks hooks;
    hooks.watch = [this](const sim::Snapshot& now) { poses_.push_back(now.vehicles_in_map); };
    sim::drive(drive, {}, hooks);
    const int there = static_cast<int>(setup_.scenario.vehicles.size());
    seeing_ = static_cast<std::size_t>(vehicles > 0 ? std::min(vehicles, there) : there);
  }

  const grid::OccupancyGrid& walls() const override { return setup_.grid; }
  double duration_s() const override {
    return poses_.size() < 2 ? 0.0 : kPeriod_s * static_cast<double>(poses_.size() - 2);
  }
  std::size_t vehicles() const override { return seeing_; }

  Moment at(double t_s) override {
    Moment moment;
    std::vector<Body> bodies;
    for (std::size_t v = 0; v < setup_.scenario.vehicles.size(); ++v) {
      moment.vehicles.push_back(carrier(v, t_s));
      Body body;
      body.base_in_map = moment.vehicles.back().base_in_map;
      body.radius_m = moment.vehicles.back().radius_m;
      bodies.push_back(body);
    }
    world_.advance_to(t_s, bodies);
    for (const fake_world::Thing& thing : world_.things()) {
      if (thing.kind == fake_world::Kind::kBlock) {
        moment.blocks.push_back(thing.body);
        continue;
      }
      const int id = ids_.try_emplace(thing.id, static_cast<int>(ids_.size()) + 1).first->second;
      moment.people.push_back({id, thing.body.base_in_map.position(), thing.velocity_in_map, thing.body.radius_m});
    }
    return moment;
  }

 private:
  Carrier carrier(std::size_t v, double t_s) const {
    const auto last = poses_.size() - 2;
    const std::size_t i = std::min(last, static_cast<std::size_t>(t_s / kPeriod_s));
    const Pose2& a = poses_[i][v];
    const Pose2& b = poses_[i + 1][v];
    Carrier carrier;
    carrier.agv_id = setup_.scenario.vehicles[v].id;
    carrier.radius_m = setup_.scenario.vehicles[v].radius_m;
    const geometry::Point2 step = geometry::from_map({0.0, 0.0, a.yaw}, b.position() - a.position());
    carrier.twist = {step.x / kPeriod_s, geometry::wrap(b.yaw - a.yaw) / kPeriod_s, 0.0};
    carrier.base_in_map =
        kinematics::advance(a, carrier.twist, std::min(kPeriod_s, t_s - kPeriod_s * static_cast<double>(i)));
    return carrier;
  }

  sim::Setup setup_;
  fake_world::World world_;
  std::vector<std::vector<Pose2>> poses_;  // every kPeriod_s from the scenario's second zero, of each vehicle
  std::size_t seeing_{0};
  std::map<std::string, int> ids_;
};

}  // namespace

std::unique_ptr<Scene> driven_scenario(const std::filesystem::path& file, int vehicles, std::uint64_t seed, Cast cast) {
  sim::Setup setup = sim::read_setup(file, seed);
  if (cast == Cast::kVehiclesOnly) {
    setup.scenario.movers.clear();
    setup.scenario.recordings.clear();
    setup.scenario.blocks.clear();
    setup.people.clear();
  }
  return std::make_unique<DrivenScenario>(setup, vehicles);
}

}  // namespace aisle::tracking
