#include "tools/referee/core/walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace aisle::referee {
namespace {

using geometry::Point2;

constexpr double kBin_m = 2.0;

/// Columns [begin, end) of a row that are occupied without a gap.
using Run = std::pair<int, int>;

/// From left to right.
std::vector<Run> runs_of_row(const grid::OccupancyGrid& map, int row) {
  std::vector<Run> runs;
  const int width = map.geometry().width;

  for (int x = 0; x < width; ++x) {
    if (map.at({x, row}) != grid::Occupancy::kOccupied) continue;
    const int begin = x;
    while (x < width && map.at({x, row}) == grid::Occupancy::kOccupied) ++x;
    runs.emplace_back(begin, x);
  }

  return runs;
}

/// Between two intervals of one axis; 0 where they overlap.
double gap(double low_a, double high_a, double low_b, double high_b) {
  return std::max({0.0, low_a - high_b, low_b - high_a});
}

}  // namespace

Walls::Walls(const grid::OccupancyGrid& map) {
  const grid::Geometry& g = map.geometry();
  low_ = g.origin_in_map;
  high_ = {low_.x + g.width * g.resolution_m, low_.y + g.height * g.resolution_m};
  collect_boxes(map);
  sort_into_bins();
}

/// Rows from below: a run that repeats in the row above grows into one box; one that does not is
/// closed.
void Walls::collect_boxes(const grid::OccupancyGrid& map) {
  const grid::Geometry& g = map.geometry();

  const auto close = [&](const Run& run, int from_row, int to_row) {
    boxes_.push_back({{low_.x + run.first * g.resolution_m, low_.y + from_row * g.resolution_m},
                      {low_.x + run.second * g.resolution_m, low_.y + to_row * g.resolution_m}});
  };

  std::map<Run, int> open;  // run -> its first row
  for (int row = 0; row <= g.height; ++row) {
    std::map<Run, int> still_open;
    if (row < g.height) {
      for (const Run& run : runs_of_row(map, row)) {
        const auto before = open.find(run);
        still_open[run] = before == open.end() ? row : before->second;
      }
    }

    for (const auto& [run, from_row] : open) {
      if (still_open.find(run) == still_open.end()) close(run, from_row, row);
    }

    open = std::move(still_open);
  }
}

/// A box stands in every bin that it reaches into.
void Walls::sort_into_bins() {
  bins_x_ = std::max(1, static_cast<int>(std::ceil((high_.x - low_.x) / kBin_m)));
  bins_y_ = std::max(1, static_cast<int>(std::ceil((high_.y - low_.y) / kBin_m)));
  bins_.resize(static_cast<std::size_t>(bins_x_) * static_cast<std::size_t>(bins_y_));
  const auto bin = [](double offset_m, int count) {
    return std::clamp(static_cast<int>(offset_m / kBin_m), 0, count - 1);
  };

  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const WallBox& box = boxes_[i];
    for (int y = bin(box.low.y - low_.y, bins_y_); y <= bin(box.high.y - low_.y, bins_y_); ++y) {
      for (int x = bin(box.low.x - low_.x, bins_x_); x <= bin(box.high.x - low_.x, bins_x_); ++x) {
        bins_[static_cast<std::size_t>(y) * static_cast<std::size_t>(bins_x_) + static_cast<std::size_t>(x)].push_back(
            i);
      }
    }
  }
}

/// Looks at the boxes of all bins that the motion, grown by kSearch_m, reaches. A box whose distance
/// from the motion's bounding box is more than the best so far cannot be nearer.
std::optional<Approach> Walls::closest(const Motion& body) const {
  const double reach_m = body.shape.reach_m();
  const Point2 low{std::min(body.begin.x, body.end.x) - reach_m, std::min(body.begin.y, body.end.y) - reach_m};
  const Point2 high{std::max(body.begin.x, body.end.x) + reach_m, std::max(body.begin.y, body.end.y) + reach_m};
  const auto bin = [](double offset_m, int count) {
    return static_cast<int>(std::clamp(std::floor(offset_m / kBin_m), 0.0, static_cast<double>(count - 1)));
  };

  // The boxes of all bins within reach, the nearest so far as a bound.
  std::optional<Approach> best;
  for (int y = bin(low.y - kSearch_m - low_.y, bins_y_); y <= bin(high.y + kSearch_m - low_.y, bins_y_); ++y) {
    for (int x = bin(low.x - kSearch_m - low_.x, bins_x_); x <= bin(high.x + kSearch_m - low_.x, bins_x_); ++x) {
      for (const std::size_t i :
           bins_[static_cast<std::size_t>(y) * static_cast<std::size_t>(bins_x_) + static_cast<std::size_t>(x)]) {
        const WallBox& box = boxes_[i];
        const double at_least_m =
            std::hypot(gap(low.x, high.x, box.low.x, box.high.x), gap(low.y, high.y, box.low.y, box.high.y));
        if (at_least_m > (best ? std::max(0.0, best->clearance_m) : kSearch_m)) continue;

        const geometry::Pose2 center{0.5 * (box.low.x + box.high.x), 0.5 * (box.low.y + box.high.y), 0.0};
        const Motion wall{{0.0, box.high.x - box.low.x, box.high.y - box.low.y}, center, center};
        const Approach approach = closest_approach(body, wall);

        if (!best || approach.clearance_m < best->clearance_m) best = approach;
      }
    }
  }

  return best && best->clearance_m <= kSearch_m ? best : std::nullopt;
}

}  // namespace aisle::referee
