#pragma once

#include <optional>
#include <vector>

#include "services/fake-world/core/recording.hpp"

namespace aisle::tracking {

/// A recorded person's way without corners. The rows were clicked into a film every 0.4 s, each with an
/// error of its own; straight lines between them jump in velocity at each, as no person does.
///
/// The way is the cubic B-spline with the rows as control points (de Boor 1978): at a row it is a third
/// of the way from the recorded place to the line between its neighbours, with the central difference
/// as velocity; first and last row are kept. For uneven rows: the cubics (Hermite) of the same places
/// and velocities.
class SmoothWalk {
 public:
  /// @pre rows in order of time, at least one. `hurry`: the person walks this much faster than the rows say.
  explicit SmoothWalk(const std::vector<fake_world::RecordedPerson::Row>& rows, double hurry = 1.0);

  /// None before the first row and after the last. The velocity is the derivative of the place.
  std::optional<fake_world::Motion> at(double t_s) const;
  double end_s() const { return knots_.back().t_s; }

 private:
  struct Knot {
    double t_s;
    geometry::Point2 in_map;
    geometry::Point2 velocity_in_map;
  };

  std::vector<Knot> knots_;
};

}  // namespace aisle::tracking
