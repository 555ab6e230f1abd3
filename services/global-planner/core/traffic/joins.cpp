#include "services/global-planner/core/traffic/joins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>

#include "common/grid/line_of_sight.hpp"
#include "services/global-planner/core/traffic/flood.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using grid::Cell;

constexpr double kReach = 1.6;       // pitches between neighbours, at most
constexpr double kPassing = 0.3;     // pitches within which no third point is passed
constexpr double kWayRound = 1.45;   // times the direct length: as good as a join
constexpr double kRoundabout = 2.0;  // times the length over the floor: a bridge is worth it

/// Points with joins between them, grown join by join.
class Joined {
 public:
  Joined(const std::vector<Point2>& points, const std::vector<Join>& joins) : points_(points), ways_(points.size()) {
    for (const Join& join : joins) add(join);
  }

  void add(const Join& join) {
    ways_[join.first].push_back(join.second);
    ways_[join.second].push_back(join.first);
  }

  bool has(const Join& join) const {
    const auto& ways = ways_[join.first];
    return std::find(ways.begin(), ways.end(), join.second) != ways.end();
  }

  /// Is there a way from one to the other of at most this length? Dijkstra, ending there.
  bool has_way(std::size_t from, std::size_t to, double most_m) const {
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    std::map<std::size_t, double> known;
    open.push({0.0, from});
    known[from] = 0.0;

    while (!open.empty()) {
      const auto [so_far_m, at] = open.top();
      open.pop();
      if (at == to) return true;
      if (so_far_m > known[at]) continue;

      for (const std::size_t next : ways_[at]) {
        const double length_m = so_far_m + distance(points_[at], points_[next]);
        if (length_m + distance(points_[next], points_[to]) > most_m) continue;

        const auto entry = known.try_emplace(next, std::numeric_limits<double>::infinity()).first;
        if (length_m >= entry->second) continue;

        entry->second = length_m;
        open.push({length_m, next});
      }
    }

    return false;
  }

 private:
  const std::vector<Point2>& points_;
  std::vector<std::vector<std::size_t>> ways_;
};

Box box_of(Point2 a, Point2 b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

/// All pairs of neighbours whose box touches `near`, the shortest first.
std::vector<Join> neighbours(const std::vector<Point2>& points, const FloorBins<std::size_t>& bins, double reach_m,
                             const Box& near) {
  std::vector<std::tuple<long long, std::size_t, std::size_t>> pairs;  // length in um

  for (std::size_t i = 0; i < points.size(); ++i) {
    bins.visit(grown({points[i], points[i]}, reach_m), [&](std::size_t j) {
      const double length_m = distance(points[i], points[j]);
      if (j > i && length_m <= reach_m && touch(box_of(points[i], points[j]), near))
        pairs.emplace_back(std::llround(length_m * 1e6), i, j);
    });
  }

  std::sort(pairs.begin(), pairs.end());
  std::vector<Join> out;
  for (const auto& [length_um, a, b] : pairs) out.emplace_back(a, b);

  return out;
}

/// Where two floods meet.
struct Meeting {
  double length_m{std::numeric_limits<double>::infinity()};
  Cell first;
  Cell second;
};

/// The shortest meeting of each pair of points that are not joined.
std::map<Join, Meeting> meetings(const Flood& flood, const Joined& joined) {
  std::map<Join, Meeting> out;

  for (int y = flood.low().y; y <= flood.high().y; ++y) {
    for (int x = flood.low().x; x <= flood.high().x; ++x) {
      const Cell here{x, y};
      const std::uint32_t a = flood.label(here);
      if (a == Flood::kDry) continue;

      for (const Cell there : {Cell{x + 1, y}, Cell{x, y + 1}}) {
        const std::uint32_t b = flood.label(there);
        if (b == Flood::kDry || a == b || joined.has({a, b})) continue;

        Meeting& known = out[{std::min(a, b), std::max(a, b)}];
        const double length_m = flood.length_m(here) + flood.length_m(there);
        if (length_m < known.length_m) known = {length_m, a < b ? here : there, a < b ? there : here};
      }
    }
  }

  return out;
}

/// One spot in each piece of floor that the flood left dry and that reaches into the box; floods them.
std::vector<Point2> find_islands(const grid::ClearanceField& clearance, Flood& flood, std::size_t next_label,
                                 const Box& touching) {
  const grid::Geometry& geometry = clearance.geometry();
  const Cell low = geometry.cell_at(touching.low_in_map);
  const Cell high = geometry.cell_at(touching.high_in_map);
  std::vector<Point2> out;

  for (int y = std::max(low.y, flood.low().y); y <= std::min(high.y, flood.high().y); ++y) {
    for (int x = std::max(low.x, flood.low().x); x <= std::min(high.x, flood.high().x); ++x) {
      if (flood.label({x, y}) != Flood::kDry || !flood.is_free({x, y})) continue;

      out.push_back(geometry.center_in_map({x, y}));
      flood.seed(out.back(), static_cast<std::uint32_t>(next_label++));
      flood.run();
    }
  }

  return out;
}

}  // namespace

JoinedSets::JoinedSets(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), std::size_t{0});
}

std::size_t JoinedSets::of(std::size_t i) {
  for (; parent_[i] != i; i = parent_[i]) parent_[i] = parent_[parent_[i]];
  return i;
}

bool JoinedSets::join(std::size_t a, std::size_t b) {
  a = of(a);
  b = of(b);
  parent_[std::max(a, b)] = std::min(a, b);
  return a != b;
}

std::vector<Join> join_neighbours(const grid::ClearanceField& clearance, const LatticeSpec& spec,
                                  const std::vector<geometry::Point2>& points, const std::vector<Join>& existing,
                                  const Box& near) {
  FloorBins<std::size_t> bins;
  for (std::size_t i = 0; i < points.size(); ++i) bins.add({points[i], points[i]}, i);

  const auto passes_third = [&](const Join& join) {
    const Point2 a = points[join.first];
    const Point2 b = points[join.second];
    bool found = false;
    bins.visit(grown(box_of(a, b), kPassing * spec.pitch_m), [&](std::size_t i) {
      const bool is_end = i == join.first || i == join.second;
      if (!is_end && geometry::distance_to_segment(points[i], a, b) < kPassing * spec.pitch_m) found = true;
    });
    return found;
  };

  Joined joined(points, existing);
  std::vector<Join> out;
  for (const Join& join : neighbours(points, bins, kReach * spec.pitch_m, near)) {
    const Point2 a = points[join.first];
    const Point2 b = points[join.second];
    if (passes_third(join) || joined.has_way(join.first, join.second, kWayRound * distance(a, b))) continue;
    if (!is_line_free(clearance, a, b, spec.need_m)) continue;

    joined.add(join);
    out.push_back(join);
  }

  return out;
}

Bridging bridge_parts(const grid::ClearanceField& clearance, double need_m, const std::vector<geometry::Point2>& points,
                      const std::vector<std::size_t>& part, const std::vector<Join>& joins, const Box& window,
                      const Box& touching) {
  Flood flood(clearance, need_m, window);
  for (std::size_t i = 0; i < points.size(); ++i) flood.seed(points[i], static_cast<std::uint32_t>(i));
  flood.run();

  Joined joined(points, joins);
  std::vector<std::pair<Join, Meeting>> found;
  for (const auto& meeting : meetings(flood, joined)) found.push_back(meeting);
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.second.length_m < b.second.length_m; });

  Bridging out;
  const std::size_t most_part = part.empty() ? 0 : *std::max_element(part.begin(), part.end());
  JoinedSets sets(most_part + 1);
  for (const auto& [join, meeting] : found) {
    const bool is_apart = sets.join(part[join.first], part[join.second]);
    if (!is_apart && joined.has_way(join.first, join.second, kRoundabout * meeting.length_m)) continue;

    joined.add(join);
    std::vector<Point2> way = flood.way_from(meeting.first);
    std::reverse(way.begin(), way.end());
    const std::vector<Point2> rest = flood.way_from(meeting.second);
    way.insert(way.end(), rest.begin(), rest.end());
    out.bridges.push_back({join, pulled_tight(clearance, need_m, way)});
  }

  out.islands = find_islands(clearance, flood, points.size(), touching);
  return out;
}

}  // namespace aisle::global_planner::traffic
