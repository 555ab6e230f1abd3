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
/// walkers vary in speed (10 % each way) and in where on their way they begin. Nobody appears on top of a vehicle: who
/// would, appears when it has left.
class World {
 public:
  /// `people`: those of each recording, in the scenario's order. `memory`: of before a restart, or null.
  World(const scenario::Scenario& scenario, std::vector<std::vector<RecordedPerson>> people, std::uint64_t seed,
        const Memory* memory);

  /// Moves on to `seconds` of the scenario; things move from then on and not before 0. Long steps are cut into short
  /// ones. `vehicles`: where they truly are.
  void advance_to(double seconds, const std::vector<geometry::Body>& vehicles);

  const std::vector<Thing>& things() const { return things_; }
  /// Ids that were there before the last call of advance_to, and are not any more.
  const std::vector<std::string>& gone() const { return gone_; }
  Memory memory() const;

  static constexpr double kBirthGapM = 0.5;

 private:
  void show(Thing thing, const std::vector<geometry::Body>& vehicles);
  void show_walkers(const std::vector<geometry::Body>& vehicles);
  void show_people(const std::vector<geometry::Body>& vehicles);

  scenario::Scenario scenario_;
  std::vector<std::vector<RecordedPerson>> people_;
  std::vector<Walker> walkers_;
  double seconds_;
  std::set<std::string> present_;
  std::vector<Thing> things_;
  std::vector<std::string> gone_;
};

}  // namespace aisle::fake_world
