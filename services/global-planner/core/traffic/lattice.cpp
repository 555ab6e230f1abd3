#include "services/global-planner/core/traffic/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;

constexpr double kEqualM = 1e-6;
constexpr double kMoveM = 0.05;
constexpr int kMoveRounds = 8;

/// A free point of a square of the lattice.
struct Candidate {
  Point2 in_map;
  double moved_m{0.0};  // from the square's centre
  double clearance_m{0.0};
};

/// The free point of the square around `centre` that is nearest to it; of equally near ones that with more clearance.
std::optional<Candidate> free_point(const grid::ClearanceField& clearance, const LatticeSpec& spec, Point2 centre) {
  const double at_centre_m = clearance.clearance_m(centre);
  if (at_centre_m >= spec.need_m) return Candidate{centre, 0.0, at_centre_m};

  const grid::Geometry& geometry = clearance.geometry();
  const double half_m = 0.5 * spec.pitch_m;
  const grid::Cell low = geometry.cell_at({centre.x - half_m, centre.y - half_m});
  const grid::Cell high = geometry.cell_at({centre.x + half_m, centre.y + half_m});
  std::optional<Candidate> best;

  for (int y = std::max(0, low.y); y <= std::min(high.y, geometry.height - 1); ++y) {
    for (int x = std::max(0, low.x); x <= std::min(high.x, geometry.width - 1); ++x) {
      if (!clearance.is_traversable({x, y}, spec.need_m)) continue;

      const Point2 p = geometry.center_in_map({x, y});
      if (std::abs(p.x - centre.x) > half_m || std::abs(p.y - centre.y) > half_m) continue;

      const Candidate here{p, distance(p, centre), clearance.clearance_m(grid::Cell{x, y})};
      const bool is_nearer = !best || here.moved_m < best->moved_m - kEqualM;
      const bool is_as_near = best && here.moved_m < best->moved_m + kEqualM;
      if (is_nearer || (is_as_near && here.clearance_m > best->clearance_m + kEqualM)) best = here;
    }
  }

  return best;
}

/// Points found again by place, for questions of who is near.
class Points {
 public:
  explicit Points(const std::vector<Point2>& points) {
    for (const Point2 p : points) add(p);
  }

  void add(Point2 p) {
    bins_.add({p, p}, points_.size());
    points_.push_back(p);
  }

  void move(std::size_t i, Point2 to) {
    bins_.remove({points_[i], points_[i]}, i);
    points_[i] = to;
    bins_.add({to, to}, i);
  }

  bool has_nearer_than(Point2 p, double range_m) const {
    bool found = false;
    bins_.visit(grown({p, p}, range_m), [&](std::size_t i) { found = found || distance(points_[i], p) < range_m; });
    return found;
  }

  /// May point i move there: nearer to no other point than it is now, or than `enough_m`?
  bool keeps_apart(std::size_t i, Point2 to, double enough_m) const {
    bool keeps = true;
    bins_.visit(grown({to, to}, enough_m), [&](std::size_t j) {
      if (j == i) return;

      const double after_m = distance(points_[j], to);
      if (after_m < enough_m - kEqualM && after_m < distance(points_[j], points_[i]) - kEqualM) keeps = false;
    });
    return keeps;
  }

  const std::vector<Point2>& all() const { return points_; }

 private:
  std::vector<Point2> points_;
  FloorBins<std::size_t> bins_;
};

/// Moves the points from `first` on, where they have less than half a pitch to spare, to the neighbouring spot with the
/// most clearance.
void move_to_room(const grid::ClearanceField& clearance, const LatticeSpec& spec, std::size_t first, Points& points) {
  const double wide_m = spec.need_m + 0.5 * spec.pitch_m;

  for (std::size_t i = first; i < points.all().size(); ++i) {
    const Point2 from = points.all()[i];
    Point2 best = from;
    double best_m = clearance.clearance_m(from);
    if (best_m >= wide_m) continue;

    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Point2 to{from.x + dx * kMoveM, from.y + dy * kMoveM};
        const double there_m = clearance.clearance_m(to);
        if (there_m <= best_m + kEqualM || !points.keeps_apart(i, to, spec.pitch_m)) continue;

        best = to;
        best_m = there_m;
      }
    }

    if (best != from) points.move(i, best);
  }
}

}  // namespace

Box floor_box(const grid::ClearanceField& clearance) {
  const grid::Geometry& geometry = clearance.geometry();
  const Point2 low = geometry.origin_in_map;
  return {low, low + Point2{geometry.width * geometry.resolution_m, geometry.height * geometry.resolution_m}};
}

std::vector<geometry::Point2> lattice_points(const grid::ClearanceField& clearance, const LatticeSpec& spec,
                                             const Box& within, const std::vector<geometry::Point2>& taken) {
  const Point2 origin = spec.origin_in_map;
  const Box floor = floor_box(clearance);
  const auto square_of = [&](double m, double origin_m) {
    return static_cast<int>(std::floor((m - origin_m) / spec.pitch_m));
  };
  const int last_x = square_of(std::min(within.high_in_map.x, floor.high_in_map.x), origin.x);
  const int last_y = square_of(std::min(within.high_in_map.y, floor.high_in_map.y), origin.y);
  std::vector<Candidate> candidates;

  for (int y = square_of(std::max(within.low_in_map.y, floor.low_in_map.y), origin.y); y <= last_y; ++y) {
    for (int x = square_of(std::max(within.low_in_map.x, floor.low_in_map.x), origin.x); x <= last_x; ++x) {
      const Point2 centre = origin + spec.pitch_m * Point2{x + 0.5, y + 0.5};
      if (!touch({centre, centre}, within)) continue;
      if (const auto point = free_point(clearance, spec, centre)) candidates.push_back(*point);
    }
  }

  const auto moved_um = [](const Candidate& c) { return std::llround(c.moved_m / kEqualM); };
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const Candidate& a, const Candidate& b) { return moved_um(a) < moved_um(b); });

  Points points(taken);
  for (const Candidate& candidate : candidates)
    if (!points.has_nearer_than(candidate.in_map, kLeastApart * spec.pitch_m)) points.add(candidate.in_map);

  for (int round = 0; round < kMoveRounds; ++round) move_to_room(clearance, spec, taken.size(), points);

  return {points.all().begin() + static_cast<std::ptrdiff_t>(taken.size()), points.all().end()};
}

}  // namespace aisle::global_planner::traffic
