#include "services/local-planner/core/local_search.hpp"

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

/// A square of (2 n + 1)^2 nodes around the start, numbered row by row; (0, 0) is the start.
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

/// From each kept point on to the farthest one, within 4 m, that can be reached straight.
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

/// Dijkstra over the lattice; the room of each node is looked up once.
class WaySearch {
 public:
  WaySearch(const Room& room, Point2 from, Point2 towards, double reach_m)
      : room_(room),
        from_(from),
        ahead_(towards - from),
        lattice_(from, reach_m),
        cost_(lattice_.size(), std::numeric_limits<double>::infinity()),
        spare_(lattice_.size(), kUnknown),
        parent_(lattice_.size(), lattice_.size()) {}

  /// The nodes from the start to the first that is accepted and has room; empty: there is none.
  std::vector<Point2> run(const std::function<bool(Point2)>& accepts) {
    const std::size_t start = lattice_.index(0, 0);
    cost_[start] = 0.0;
    open_.push({0.0, start});

    while (!open_.empty()) {
      const auto [so_far, i] = open_.top();
      open_.pop();
      if (so_far > cost_[i]) continue;
      if (accepts(lattice_.at(i)) && spare_at(i) >= 0.0) return way_to(i);
      expand(i, so_far);
    }

    return {};
  }

 private:
  static constexpr double kUnknown = -std::numeric_limits<double>::infinity();
  using Entry = std::pair<double, std::size_t>;  // cost, node

  /// The room at a node, looked up when it is first asked for.
  double spare_at(std::size_t i) {
    if (spare_[i] == kUnknown) spare_[i] = room_.spare_m(lattice_.at(i));

    return spare_[i];
  }

  /// Reaches the neighbours that this node makes cheaper.
  void expand(std::size_t i, double so_far) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = lattice_.x_of(i) + dx;
        const int y = lattice_.y_of(i) + dy;
        if ((dx == 0 && dy == 0) || !lattice_.contains(x, y)) continue;

        const std::size_t k = lattice_.index(x, y);
        if (!may_step(i, k)) continue;
        const double total = so_far + kStepM * std::hypot(dx, dy) * dearness(k);

        if (total < cost_[k]) {
          cost_[k] = total;
          parent_[k] = i;
          open_.push({total, k});
        }
      }
  }

  /// Out of too little room, never deeper into it; where room is tight, the middle of the step is looked at too.
  bool may_step(std::size_t i, std::size_t k) {
    const double here = spare_at(k);
    if (here < 0.0 && here < spare_at(i) + kRoundingM) return false;
    const bool is_tight = here >= 0.0 && here < kTightM && spare_at(i) >= 0.0;

    return !is_tight || room_.spare_m(0.5 * (lattice_.at(i) + lattice_.at(k))) >= 0.0;
  }

  /// Of a step to this node, a factor: dearer near obstacles and left of the line ahead.
  double dearness(std::size_t k) {
    const double near = std::max(0.0, kDearM - spare_at(k)) / kDearM;
    const bool is_left = geometry::cross(ahead_, lattice_.at(k) - from_) > kLeftM2;

    return 1.0 + near + (is_left ? kLeftDearer : 0.0);
  }

  /// The nodes from the start to this one.
  std::vector<Point2> way_to(std::size_t i) const {
    std::vector<Point2> way;
    for (std::size_t j = i; j != lattice_.size(); j = parent_[j]) way.push_back(lattice_.at(j));
    std::reverse(way.begin(), way.end());

    return way;
  }

  const Room& room_;
  Point2 from_;
  Point2 ahead_;
  Lattice lattice_;
  std::vector<double> cost_;
  std::vector<double> spare_;  // room at each node, in metres
  std::vector<std::size_t> parent_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

}  // namespace

std::vector<Point2> search_way(const Room& room, Point2 from, Point2 towards, double reach_m,
                               const std::function<bool(Point2)>& accepts) {
  const std::vector<Point2> way = WaySearch(room, from, towards, reach_m).run(accepts);
  return way.empty() ? way : straighten(room, way);
}

}  // namespace aisle::local_planner
