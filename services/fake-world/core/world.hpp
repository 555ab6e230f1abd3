#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/geometry/body.hpp"
#include "common/scenario/scenario.hpp"
#include "services/fake-world/core/recording.hpp"
#include "services/fake-world/core/walker.hpp"

namespace aisle::fake_world {

/// A person moves; a block stands.
enum class Kind { kPerson, kBlock };

/// Something that is there now.
struct Thing {
  std::string id;
  Kind kind{Kind::kPerson};
  geometry::Body body;
  geometry::Point2 velocity_in_map;  // m/s
};

/// What a restarted world needs to go on where it was.
struct Memory {
  double seconds{0.0};
  std::map<std::string, Walker::Progress> walkers;
  std::set<std::string> present;  // ids of what was there
};

/// All that moves or stands in a scenario beside its vehicles: walkers, recorded people and hidden blocks. By seed,
/// walkers vary in speed (10 % each way) and in where on their way they begin. Nothing appears on top of a vehicle: it
/// waits until the vehicle has left. Walkers keep apart from all persons; where two walkers would meet, the one that
/// the scenario names first goes first. Recorded people move as recorded.
class World {
 public:
  /// @param people those of each recording, in the scenario's order
  /// @param seed of the walkers' speeds and places
  /// @param memory what memory() gave before a restart, or null
  World(const scenario::Scenario& scenario, std::vector<std::vector<RecordedPerson>> people, std::uint64_t seed,
        const Memory* memory);

  /// Moves on to `seconds` since the scenario's second zero, in steps of at most 50 ms; a time in the past moves
  /// nothing. `vehicles`: their true bodies in map.
  void advance_to(double seconds, const std::vector<geometry::Body>& vehicles);

  /// All things that are there now, in map.
  const std::vector<Thing>& things() const { return things_; }

  /// Ids that were there before the last call of advance_to, and are not any more.
  const std::vector<std::string>& gone() const { return gone_; }

  /// What a new process needs to go on from here.
  Memory memory() const;

  static constexpr double kBirthGapM = 0.5;  // free space to each vehicle that a new thing needs

 private:
  /// Moves all walkers by one step.
  void step_walkers(double dt_s, const std::vector<geometry::Body>& vehicles);

  /// Calls visit(id, motion, radius_m) for each recorded person that is there now.
  template <class Visit>
  void visit_recorded(const Visit& visit) const;

  /// Adds the thing unless it is new and too near to a vehicle.
  void show(Thing thing, const std::vector<geometry::Body>& vehicles);

  /// Adds the walkers, and the recorded people of this second.
  void show_walkers(const std::vector<geometry::Body>& vehicles);
  void show_people(const std::vector<geometry::Body>& vehicles);

  scenario::Scenario scenario_;
  std::vector<std::vector<RecordedPerson>> people_;
  std::vector<Walker> walkers_;
  double seconds_;

  std::set<std::string> present_;  // ids of things_
  std::vector<Thing> things_;
  std::vector<std::string> gone_;
};

}  // namespace aisle::fake_world
