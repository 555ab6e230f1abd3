#include "services/fake-world/core/world.hpp"

#include <algorithm>
#include <iterator>
#include <random>
#include <utility>

#include "common/scenario/variation.hpp"

namespace aisle::fake_world {
namespace {

constexpr double kLongestStepS = 0.05;
constexpr double kSpeedSpread = 0.1;  // of a walker's speed, each way

/// The walker with its own speed and its own place on the way, drawn by seed and id; after a restart it is where
/// `memory` has it.
Walker varied(const scenario::Mover& mover, std::uint64_t seed, const Memory* memory) {
  std::mt19937_64 random = scenario::random_for(seed, mover.id);
  scenario::Mover own = mover;
  own.speed_mps *= std::uniform_real_distribution<double>(1.0 - kSpeedSpread, 1.0 + kSpeedSpread)(random);

  Walker::Progress progress;
  if (mover.loop) {
    const double span_m = 0.25 * Walker(own, {}).length_m();
    progress.along_m = std::uniform_real_distribution<double>(0.0, span_m)(random);
  }

  if (memory != nullptr) {
    const auto kept = memory->walkers.find(mover.id);
    if (kept != memory->walkers.end()) progress = kept->second;
  }

  return Walker(own, progress);
}

/// A person's body.
geometry::Body disc(geometry::Point2 in_map, double radius_m) {
  geometry::Body body;
  body.base_in_map = {in_map.x, in_map.y, 0.0};
  body.radius_m = radius_m;

  return body;
}

/// A hidden block of the scenario.
Thing thing_of(const scenario::Block& block) {
  Thing thing{block.id, Kind::kBlock, {}, {}};
  thing.body.shape = geometry::Body::Shape::kRectangle;
  thing.body.base_in_map = block.center_in_map;
  thing.body.length_m = block.length_m;
  thing.body.width_m = block.width_m;

  return thing;
}

/// Is there at least `gap_m` between the thing and each vehicle, taken as the circle around its outline?
bool is_clear_of(const std::vector<geometry::Body>& vehicles, const geometry::Body& body, double gap_m) {
  return std::all_of(vehicles.begin(), vehicles.end(), [&](const geometry::Body& vehicle) {
    return geometry::distance_m(body, vehicle.base_in_map.position()) - geometry::reach_m(vehicle) >= gap_m;
  });
}

}  // namespace

World::World(const scenario::Scenario& scenario, std::vector<std::vector<RecordedPerson>> people, std::uint64_t seed,
             const Memory* memory)
    : scenario_(scenario), people_(std::move(people)), seconds_(memory != nullptr ? memory->seconds : 0.0) {
  if (memory != nullptr) present_ = memory->present;
  for (const scenario::Mover& mover : scenario_.movers) walkers_.push_back(varied(mover, seed, memory));
}

void World::advance_to(double seconds, const std::vector<geometry::Body>& vehicles) {
  // Short steps, so that walkers see a vehicle in time whatever the caller's period is.
  while (seconds_ < seconds) {
    const double dt_s = std::min(kLongestStepS, seconds - seconds_);
    seconds_ += dt_s;
    step_walkers(dt_s, vehicles);
  }

  // What is there now.
  things_.clear();
  show_walkers(vehicles);
  show_people(vehicles);
  for (const scenario::Block& block : scenario_.blocks) {
    if (seconds_ >= block.appear_s) show(thing_of(block), vehicles);
  }

  // What went: ids of the last call that are not among today's.
  const std::set<std::string> before = std::exchange(present_, {});
  for (const Thing& thing : things_) present_.insert(thing.id);

  gone_.clear();
  std::set_difference(before.begin(), before.end(), present_.begin(), present_.end(), std::back_inserter(gone_));
}

template <class Visit>
void World::visit_recorded(const Visit& visit) const {
  for (std::size_t i = 0; i < people_.size(); ++i) {
    const scenario::Recording& recording = scenario_.recordings[i];
    const double t_s = recording.begin_s + seconds_;
    if (t_s > recording.end_s) continue;

    for (const RecordedPerson& person : people_[i]) {
      if (const std::optional<Motion> motion = person.at(t_s)) visit(person.id(), *motion, recording.radius_m);
    }
  }
}

void World::step_walkers(double dt_s, const std::vector<geometry::Body>& vehicles) {
  if (walkers_.empty()) return;

  std::vector<Walker::Neighbour> recorded;
  visit_recorded([&](const std::string&, const Motion& motion, double radius_m) {
    recorded.push_back({motion.position_in_map, motion.velocity_in_map, radius_m, true});
  });

  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    if (seconds_ < walkers_[i].mover().start_s) continue;

    // All persons but this one; those that the scenario names before it go first.
    std::vector<Walker::Neighbour> others = recorded;
    for (std::size_t j = 0; j < walkers_.size(); ++j) {
      if (j == i) continue;

      const Motion motion = walkers_[j].motion();
      others.push_back({motion.position_in_map, motion.velocity_in_map, walkers_[j].mover().radius_m, j < i});
    }

    walkers_[i].step(dt_s, vehicles, others);
  }
}

void World::show_walkers(const std::vector<geometry::Body>& vehicles) {
  for (const Walker& walker : walkers_) {
    const Motion motion = walker.motion();
    show({walker.mover().id, Kind::kPerson, disc(motion.position_in_map, walker.mover().radius_m),
          motion.velocity_in_map},
         vehicles);
  }
}

void World::show_people(const std::vector<geometry::Body>& vehicles) {
  visit_recorded([&](const std::string& id, const Motion& motion, double radius_m) {
    show({id, Kind::kPerson, disc(motion.position_in_map, radius_m), motion.velocity_in_map}, vehicles);
  });
}

void World::show(Thing thing, const std::vector<geometry::Body>& vehicles) {
  const bool was_there = present_.count(thing.id) > 0;
  if (was_there || is_clear_of(vehicles, thing.body, kBirthGapM)) things_.push_back(std::move(thing));
}

Memory World::memory() const {
  Memory memory;
  memory.seconds = seconds_;
  memory.present = present_;
  for (const Walker& walker : walkers_) memory.walkers[walker.mover().id] = walker.progress();

  return memory;
}

}  // namespace aisle::fake_world
