#include "services/global-planner/core/connected_parts.hpp"

#include <algorithm>
#include <limits>

namespace aisle::global_planner {

bool ConnectedParts::is_made_for(const Drivable& drivable) const {
  return field_revision_ == drivable.field_revision() && least_m_ == drivable.least_m() && !has_tight_end_ &&
         !drivable.has_tight_end();
}

void ConnectedParts::make(const Drivable& drivable) {
  if (is_made_for(drivable)) return;

  geometry_ = drivable.geometry();
  field_revision_ = drivable.field_revision();
  least_m_ = drivable.least_m();
  has_tight_end_ = drivable.has_tight_end();
  bits_.make(drivable);

  runs_.clear();

  rows_.assign(1, 0);

  // From the bottom up: find the runs of each row, and join them to those below.
  for (int y = 0; y < geometry_.height; ++y) {
    add_row(y);
    if (y > 0) join_to_row_below(y);
  }

  // Name each part by its first run, which has the lowest index and is therefore done already.
  for (Run& run : runs_) run.part = runs_[run.part].part;
}

/// A run begins or ends where a cell differs from the one before: the bits of cells ^ (cells << 1), of which the lowest
/// one is found and cleared until none is left.
void ConnectedParts::add_row(int y) {
  bool is_in_run = false;
  for (int at = 0; at < geometry_.width; at += 64) {
    const std::uint64_t cells = bits_.rows().cells(y, at);
    for (std::uint64_t changes = cells ^ (cells << 1U | (is_in_run ? 1U : 0U)); changes != 0; changes &= changes - 1) {
      const int x = at + __builtin_ctzll(changes);
      if (is_in_run) {
        runs_.back().end = x;
      } else {
        runs_.push_back({x, geometry_.width, static_cast<std::uint32_t>(runs_.size())});
      }

      is_in_run = !is_in_run;
    }
  }

  rows_.push_back(runs_.size());
}

/// A diagonal step needs both orthogonal ones, so runs touch where a cell of one lies above a cell of the other. Both
/// rows are walked from left to right at once.
void ConnectedParts::join_to_row_below(int y) {
  std::size_t above = rows_[static_cast<std::size_t>(y)];
  std::size_t below = rows_[static_cast<std::size_t>(y) - 1];
  const std::size_t end_above = rows_[static_cast<std::size_t>(y) + 1];
  const std::size_t end_below = above;

  while (above < end_above && below < end_below) {
    if (runs_[above].begin < runs_[below].end && runs_[below].begin < runs_[above].end) {
      const std::uint32_t a = first_of(static_cast<std::uint32_t>(above));
      const std::uint32_t b = first_of(static_cast<std::uint32_t>(below));
      runs_[std::max(a, b)].part = std::min(a, b);
    }

    ++(runs_[above].end < runs_[below].end ? above : below);
  }
}

/// Union-find with path halving.
std::uint32_t ConnectedParts::first_of(std::uint32_t run) {
  while (runs_[run].part != run) run = runs_[run].part = runs_[runs_[run].part].part;
  return run;
}

const ConnectedParts::Run* ConnectedParts::run_of(grid::Cell cell) const {
  const auto begin = runs_.begin() + static_cast<std::ptrdiff_t>(rows_[static_cast<std::size_t>(cell.y)]);
  const auto end = runs_.begin() + static_cast<std::ptrdiff_t>(rows_[static_cast<std::size_t>(cell.y) + 1]);
  const auto after = std::upper_bound(begin, end, cell.x, [](int x, const Run& run) { return x < run.begin; });

  return after != begin && cell.x < (after - 1)->end ? &*(after - 1) : nullptr;
}

bool ConnectedParts::are_apart(grid::Cell a, grid::Cell b) const {
  const Run* const of_a = run_of(a);
  const Run* const of_b = run_of(b);
  return of_a != nullptr && of_b != nullptr && of_a->part != of_b->part;
}

std::optional<grid::Cell> ConnectedParts::nearest(grid::Cell from, geometry::Point2 to_in_map) const {
  const Run* const start = run_of(from);
  if (start == nullptr) return {};

  const double to_x = (to_in_map.x - geometry_.origin_in_map.x) / geometry_.resolution_m;
  const int column = to_x > 0.0 ? static_cast<int>(std::min<double>(to_x, geometry_.width)) : 0;

  // In each run of the part the nearest cell is the one at the point's column, or the end of the run towards it.
  grid::Cell nearest = from;
  double nearest_m2 = std::numeric_limits<double>::infinity();
  for (int y = 0; y < geometry_.height; ++y) {
    for (std::size_t i = rows_[static_cast<std::size_t>(y)]; i < rows_[static_cast<std::size_t>(y) + 1]; ++i) {
      if (runs_[i].part != start->part) continue;
      const grid::Cell cell{std::clamp(column, runs_[i].begin, runs_[i].end - 1), y};

      const geometry::Point2 apart = geometry_.center_in_map(cell) - to_in_map;
      const double distance_m2 = geometry::dot(apart, apart);
      if (distance_m2 >= nearest_m2) continue;

      nearest_m2 = distance_m2;
      nearest = cell;
    }
  }

  return nearest;
}

}  // namespace aisle::global_planner
