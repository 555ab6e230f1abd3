#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/grid/clearance.hpp"
#include "services/obstacle-tracker/core/tracker.hpp"

namespace aisle::tracking {

/// A tracker that takes part in a trial: it gets every scan as it comes, and is asked for its tracks
/// when all vehicles have scanned.
class Contestant {
 public:
  virtual ~Contestant() = default;
  virtual std::string name() const = 0;

  /// `vehicles`: what the fleet says of them; `clearance`: of the walls; `now`: when the scan came.
  virtual void take(const obstacle_tracker::Scan& scan, const std::vector<obstacle_tracker::KnownVehicle>& vehicles,
                    const grid::ClearanceField& clearance, time::Stamp now) = 0;

  /// The tracks as of the last ray of the newest scan, by id.
  virtual std::vector<fleet::Track> tracks(time::Stamp now) const = 0;
};

/// The tracker of aisle-obstacle-tracker, named after its filter.
std::unique_ptr<Contestant> make_aisle(const obstacle_tracker::TrackerParams& params = {});

/// With its usual parameters but for the filter: one of obstacle_tracker::all_filters().
std::unique_ptr<Contestant> make_aisle(const std::string& filter);

/// The baseline, a tracker as it can be written in a weekend (see nearest_neighbour.cpp).
std::unique_ptr<Contestant> make_nearest_neighbour();

}  // namespace aisle::tracking
