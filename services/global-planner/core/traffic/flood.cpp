#include "services/global-planner/core/traffic/flood.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/grid/line_of_sight.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using grid::Cell;

constexpr std::array<Cell, 8> kAround{Cell{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
constexpr std::uint8_t kSeed = 255;

std::uint8_t direction(Cell from, Cell to) {
  const auto step = std::find(kAround.begin(), kAround.end(), Cell{to.x - from.x, to.y - from.y});
  return static_cast<std::uint8_t>(step - kAround.begin());
}

}  // namespace

Flood::Flood(const grid::ClearanceField& clearance, double need_m, const Box& window)
    : clearance_(clearance), need_m_(need_m) {
  const grid::Geometry& geometry = clearance.geometry();
  low_ = geometry.cell_at(window.low_in_map);
  high_ = geometry.cell_at(window.high_in_map);
  low_ = {std::clamp(low_.x, 0, geometry.width), std::clamp(low_.y, 0, geometry.height)};
  high_ = {std::clamp(high_.x, -1, geometry.width - 1), std::clamp(high_.y, -1, geometry.height - 1)};

  width_ = static_cast<std::size_t>(std::max(0, high_.x - low_.x + 1));
  const std::size_t cells = width_ * static_cast<std::size_t>(std::max(0, high_.y - low_.y + 1));
  labels_.assign(cells, kDry);
  length_m_.assign(cells, 0.0F);
  came_from_.assign(cells, kSeed);
}

void Flood::reach(Cell cell, std::uint32_t label, Cell from, double length_m) {
  const std::size_t i = index(cell);
  labels_[i] = label;
  length_m_[i] = static_cast<float>(length_m);
  came_from_[i] = cell == from ? kSeed : direction(from, cell);
  open_.push_back(cell);
}

void Flood::seed(geometry::Point2 at_in_map, std::uint32_t label) {
  if (label >= seeds_.size()) seeds_.resize(label + 1);
  seeds_[label] = at_in_map;

  const Cell middle = clearance_.geometry().cell_at(at_in_map);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Cell cell{middle.x + dx, middle.y + dy};
      if (!is_free(cell) || labels_[index(cell)] != kDry) continue;

      const Point2 centre = clearance_.geometry().center_in_map(cell);
      if (is_line_free(clearance_, at_in_map, centre, need_m_)) reach(cell, label, cell, distance(at_in_map, centre));
    }
  }
}

void Flood::run() {
  const double cell_m = clearance_.geometry().resolution_m;

  for (; next_ < open_.size(); ++next_) {
    const Cell from = open_[next_];
    const std::uint32_t label = labels_[index(from)];
    const double so_far_m = length_m_[index(from)];

    for (const Cell step : kAround) {
      const Cell to{from.x + step.x, from.y + step.y};
      if (!is_free(to) || labels_[index(to)] != kDry) continue;

      const bool is_diagonal = step.x != 0 && step.y != 0;
      if (is_diagonal && !(is_free({to.x, from.y}) && is_free({from.x, to.y}))) continue;

      reach(to, label, from, so_far_m + (is_diagonal ? std::sqrt(2.0) : 1.0) * cell_m);
    }
  }
}

std::vector<geometry::Point2> Flood::way_from(grid::Cell cell) const {
  std::vector<Point2> way{clearance_.geometry().center_in_map(cell)};

  for (std::uint8_t step = came_from_[index(cell)]; step != kSeed; step = came_from_[index(cell)]) {
    cell = {cell.x - kAround[step].x, cell.y - kAround[step].y};
    way.push_back(clearance_.geometry().center_in_map(cell));
  }

  way.push_back(seeds_[label(cell)]);
  return way;
}

std::vector<geometry::Point2> pulled_tight(const grid::ClearanceField& clearance, double need_m,
                                           const std::vector<geometry::Point2>& way_in_map) {
  if (way_in_map.size() < 3) return way_in_map;

  std::vector<Point2> out{way_in_map.front()};
  for (std::size_t at = 0; at + 1 < way_in_map.size();) {
    std::size_t next = way_in_map.size() - 1;
    while (next > at + 1 && !is_line_free(clearance, way_in_map[at], way_in_map[next], need_m)) --next;

    out.push_back(way_in_map[next]);
    at = next;
  }

  return out;
}

}  // namespace aisle::global_planner::traffic
