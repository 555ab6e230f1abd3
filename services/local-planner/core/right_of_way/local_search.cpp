#include "services/local-planner/core/right_of_way/local_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kStepM = 0.2;          // of the lattice
constexpr double kLongestPieceM = 4.0;  // of a straightened way
constexpr double kRoundingM = 1e-9;
constexpr double kTightM = 0.1;       // less to spare than this: the middle between two nodes is looked at too
constexpr double kDearM = 0.3;        // less to spare than this is dearer, up to twice the length
constexpr double kLeftM2 = 0.1;       // of the cross product: this and more is left of the line ahead,
constexpr double kLeftDearer = 0.15;  // and by this share dearer

/// A square of (2 n + 1)^2 nodes around the start.
class Lattice {
 public:
  Lattice(Point2 center, double reach_m) : center_(center), half_(static_cast<int>(std::ceil(reach_m / kStepM))) {}
  int width() const { return 2 * half_ + 1; }
  std::size_t size() const { return static_cast<std::size_t>(width()) * static_cast<std::size_t>(width()); }
  bool contains(int x, int y) const { return std::abs(x) <= half_ && std::abs(y) <= half_; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y + half_) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(x + half_);
  }
  int x_of(std::size_t i) const { return static_cast<int>(i) % width() - half_; }
  int y_of(std::size_t i) const { return static_cast<int>(i) / width() - half_; }
  Point2 at(std::size_t i) const { return {center_.x + kStepM * x_of(i), center_.y + kStepM * y_of(i)}; }

 private:
  Point2 center_;
  int half_;
};

std::vector<Point2> straighten(const Room& room, const std::vector<Point2>& way) {
  std::vector<Point2> out{way.front()};
  std::size_t kept = 0;
  while (kept + 1 < way.size()) {
    std::size_t next = kept + 1;
    while (next + 1 < way.size() && geometry::distance(way[kept], way[next + 1]) < kLongestPieceM &&
           room.is_line_free(way[kept], way[next + 1]))
      ++next;
    out.push_back(way[next]);
    kept = next;
  }
  return out;
}

}  // namespace

std::vector<Point2> search_way(const Room& room, Point2 from, Point2 towards, double reach_m,
                               const std::function<bool(Point2)>& accepts) {
  const Lattice lattice(from, reach_m);
  constexpr double kUnknown = -std::numeric_limits<double>::infinity();
  std::vector<double> cost(lattice.size(), std::numeric_limits<double>::infinity());
  std::vector<double> spare(lattice.size(), kUnknown);
  std::vector<std::size_t> parent(lattice.size(), lattice.size());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto spare_at = [&](std::size_t i) {
    if (spare[i] == kUnknown) spare[i] = room.spare_m(lattice.at(i));
    return spare[i];
  };
  const std::size_t start = lattice.index(0, 0);
  const Point2 ahead = towards - from;
  cost[start] = 0.0;
  open.push({0.0, start});
  while (!open.empty()) {
    const auto [so_far, i] = open.top();
    open.pop();
    if (so_far > cost[i]) continue;
    if (accepts(lattice.at(i)) && spare_at(i) >= 0.0) {
      std::vector<Point2> way;
      for (std::size_t j = i; j != lattice.size(); j = parent[j]) way.push_back(lattice.at(j));
      std::reverse(way.begin(), way.end());
      return straighten(room, way);
    }
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = lattice.x_of(i) + dx;
        const int y = lattice.y_of(i) + dy;
        if ((dx == 0 && dy == 0) || !lattice.contains(x, y)) continue;
        const std::size_t k = lattice.index(x, y);
        const double here = spare_at(k);
        if (here < 0.0 && here < spare_at(i) + kRoundingM) continue;  // out of too little room, never deeper into it
        const Point2 p = lattice.at(k);
        if (here >= 0.0 && here < kTightM && spare_at(i) >= 0.0 && room.spare_m(0.5 * (lattice.at(i) + p)) < 0.0)
          continue;
        const double near = std::max(0.0, kDearM - here) / kDearM;
        const bool left = geometry::cross(ahead, p - from) > kLeftM2;
        const double total = so_far + kStepM * std::hypot(dx, dy) * (1.0 + near + (left ? kLeftDearer : 0.0));
        if (total < cost[k]) cost[k] = total, parent[k] = i, open.push({total, k});
      }
  }
  return {};
}

}  // namespace aisle::local_planner
