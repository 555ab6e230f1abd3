#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/grid/clearance.hpp"
#include "services/global-planner/core/traffic/shape.hpp"

namespace aisle::global_planner::traffic {

/// A pose of the lattice: steps of kPosePitchM along x and y from its origin, and quarter turns.
struct PoseKey {
  int x{0};
  int y{0};
  int quarter{0};  // heading in right angles, 0 to 3
};

inline constexpr double kPosePitchM = 0.5;

/// A motion from a pose at the origin of the lattice, in the lattice's axes.
struct PoseMove {
  PoseKey to;  // relative place, absolute heading
  std::vector<geometry::Point2> path;
  std::vector<double> headings_rad;
  Shape shape;
  bool is_reverse{false};
};

/// Poses of a vehicle that does not turn on the spot, and what it can drive between them: straights of 0.5 and 1 m,
/// quarter circles of two radii, and 0.5 m straight back where it may.
class PoseLattice {
 public:
  explicit PoseLattice(const Kind& kind);

  /// The motions from a pose of this heading.
  const std::vector<PoseMove>& moves(int quarter) const { return moves_[static_cast<std::size_t>(quarter)]; }

  /// No motion reaches farther than this, in metres, outline included.
  double reach_m() const { return reach_m_; }

 private:
  std::array<std::vector<PoseMove>, 4> moves_;
  double reach_m_{0.0};
};

/// The heading of so many right angles, (-pi, pi].
double heading_of(int quarter);

/// Is the floor that the vehicle sweeps, without its tube, free of walls? The margin counts for the outline's long
/// sides; its corners may be nearer by what the discs that cover it stand out.
/// @param shape of the kind: standing_shape() or swept_shape()
bool is_floor_free(const grid::ClearanceField& clearance, const Kind& kind, const Shape& shape);

/// The number of each node's part: nodes that reach each other have one number (Tarjan 1972).
/// @param next of each node
std::vector<std::uint32_t> strongly_connected_parts(const std::vector<std::vector<std::uint32_t>>& next);

}  // namespace aisle::global_planner::traffic
