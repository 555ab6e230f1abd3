#pragma once
#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "tools/lab/planning/drawn_map.hpp"

namespace aisle::lab {

/// How many movers and unknown boxes a paper puts into a vehicle's way, beside its map.
struct Surprises {
  int movers{0};
  int hidden_boxes{0};
  bool any() const { return movers + hidden_boxes > 0; }
};

/// Movers and boxes at fixed places and times of a map, in map, seconds since the site began.
struct Encounters {
  std::vector<scenario::Mover> movers;  // discs of 0.25 m that walk to and fro and stop for nobody
  std::vector<scenario::Block> boxes;   // of 0.5 x 0.5 m, unknown to the map
};

/// The speed by which movers are timed: of a vehicle that reaches `max_speed_mps`, its way's curves included.
double nominal_speed_mps(double max_speed_mps);

/// What every contestant on this map meets: computed from the map, its start and goal and the paper's top speed alone,
/// never from a contestant's own path.
///
///   the path of a plain A* ─► movers at 1/(n+1), 2/(n+1), ... of it, across it ─► boxes on it, away from the movers
///
/// A mover walks at 0.5 m/s to and fro across that path, 1.4 m to each side or as far as the walls leave it, and is on
/// the path when a vehicle at nominal_speed_mps is there. A box stands only where a vehicle can pass beside it; where
/// the map has no such place there are fewer than asked for.
Encounters encounters_on(const DrawnMap& map, const Surprises& surprises, double max_speed_mps);

/// The same for the drawing `name` of a paper's map (deploy/experiments/<name>.txt): what the paper prints the place of
/// stands there, which is LI's mover from (14, 7) to (14, 11); all other places stand in the papers' pictures alone.
Encounters encounters_of_paper(const std::string& name, const DrawnMap& map, const Surprises& surprises,
                               double max_speed_mps);

void add(const Encounters& encounters, scenario::Scenario& scenario);

}  // namespace aisle::lab
