#pragma once
#include <set>
#include <string>
#include <vector>

#include "common/geometry/body.hpp"
#include "common/grid/clearance.hpp"
#include "tools/lockstep/simulation.hpp"
#include "tools/sim/scenarios/gap_to_walls.hpp"

namespace aisle::lockstep {

using sim::gap_to_walls_m;

/// Counts contacts of vehicles (discs or rectangles) with walls, things and each other, each from its beginning until
/// they are 2 cm apart.
class Judge {
 public:
  struct JudgedVehicle {
    std::string id;
    geometry::Body body;
    bool is_moving{false};
  };
  struct Thing {
    std::string id;
    geometry::Body body;
  };
  /// Returns each new contact, and each that a vehicle in motion makes worse.
  std::vector<Touch> look(const std::vector<JudgedVehicle>& vehicles, const std::vector<Thing>& things,
                          const grid::OccupancyGrid& walls, const grid::ClearanceField& clearance, Result& result);

 private:
  void pair(const JudgedVehicle& vehicle, const std::string& other, double gap_m, Result& result,
            std::vector<Touch>& touches);
  std::set<std::string> touching_, moving_;
};

}  // namespace aisle::lockstep
