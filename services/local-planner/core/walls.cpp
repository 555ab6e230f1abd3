#include "services/local-planner/core/walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/grid/clearance_batch.hpp"

namespace aisle::local_planner {

using geometry::any;
using geometry::Batch;
using geometry::BatchMask;
using geometry::least;
using geometry::most;

namespace {

constexpr double kNeverM = std::numeric_limits<double>::infinity();

/// Of the four numbers of a batch.
[[gnu::always_inline]] inline double least_of(const Batch& batch) {
  return least(least(batch[0], batch[1]), least(batch[2], batch[3]));
}

[[gnu::always_inline]] inline double most_of(const Batch& batch) {
  return most(most(batch[0], batch[1]), most(batch[2], batch[3]));
}

}  // namespace

double swing_m(const Scene& scene) {
  double farthest_m = 0.0;
  for (const double ahead_m : scene.discs_ahead_m) farthest_m = std::max(farthest_m, std::abs(ahead_m));
  return farthest_m;
}

AISLE_BATCHED Box Box::around(const ArcBlock& arcs) {
  Batch low_x = arcs.batches[0].x;
  Batch high_x = low_x;
  Batch low_y = arcs.batches[0].y;
  Batch high_y = low_y;

  for (const Arc<Batch>& arc : arcs.batches) {
    low_x = least(low_x, arc.x);
    high_x = most(high_x, arc.x);
    low_y = least(low_y, arc.y);
    high_y = most(high_y, arc.y);
  }

  return {{least_of(low_x), least_of(low_y)}, {most_of(high_x), most_of(high_y)}};
}

AISLE_BATCHED void Outlines::find_headings() {
  if (is_disc_) return;
  for (std::size_t b = 0; b < kBatches; ++b)
    cos_yaw_[b] = arcs_.batches[b].cos_yaw(), sin_yaw_[b] = arcs_.batches[b].sin_yaw();
}

WallGaps::WallGaps(const Outlines& outlines, const DiscGaps& gaps_m, double enough_m)
    : outlines_(outlines), enough_m_(enough_m) {
  driven_m_.fill(0.0);
  enough_until_m_.fill(*std::min_element(gaps_m.begin(), gaps_m.end()) - enough_m);
  least_m_.fill(enough_m);
  for (std::size_t disc = 0; disc < outlines.scene().discs_ahead_m.size(); ++disc)
    far_until_m_[disc].fill(gaps_m[disc] - enough_m);
}

void WallGaps::leave(std::size_t i) { enough_until_m_[i] = kNeverM; }

bool WallGaps::look(const PerSample& driven_m) {
  drive_on(driven_m);
  return due_count_ > 0 && look_up();
}

AISLE_BATCHED void WallGaps::drive_on(const PerSample& driven_m) {
  due_count_ = 0;

  for (std::size_t b = 0; b < kBatches; ++b) {
    const Batch so_far_m = driven_m_.batch(b) + driven_m.batch(b);
    driven_m_.put(b, so_far_m);
    due_[due_count_] = b;  // without a branch, which no machine could predict
    due_count_ += any(so_far_m > enough_until_m_.batch(b)) ? 1 : 0;
  }
}

AISLE_BATCHED bool WallGaps::look_up() {
  const Scene& scene = outlines_.scene();
  const grid::ClearanceBatch clearance(scene.clearance);
  const double radius_m = scene.radius_m;
  const std::size_t discs = scene.discs_ahead_m.size();

  BatchMask is_near{};
  for (std::size_t k = 0; k < due_count_; ++k) {
    const std::size_t b = due_[k];
    const Batch driven_m = driven_m_.batch(b);
    const Batch enough_until_m = enough_until_m_.batch(b);
    Batch least_m = least_m_.batch(b);
    Batch next_m = Batch{} + kNeverM;

    // Samples that were left have infinity here and are computed along without effect.
    const BatchMask is_wanted = enough_until_m < kNeverM;
    const bool is_near_already = any(is_wanted & (least_m < enough_m_));

    for (std::size_t disc = 0; disc < discs; ++disc) {
      Batch far_until_m = far_until_m_[disc].batch(b);

      // Due: a sample has driven as far as this disc had to spare. Roughly first, exactly when that is not enough.
      if (any(is_wanted & (driven_m > far_until_m))) {
        Batch x, y, found_m;
        outlines_.find_centers(disc, b, x, y);
        if (!is_near_already) found_m = clearance.rough_m(x, y);
        if (is_near_already || any(is_wanted & (found_m - radius_m < least_m)))
          found_m = clearance.clearance_m(x, y, is_wanted);

        const Batch gap_m = found_m - radius_m;
        is_near |= is_wanted & (gap_m < enough_m_);
        least_m = is_wanted & (gap_m < least_m) ? gap_m : least_m;

        far_until_m = driven_m + (gap_m - least_m);
        far_until_m_[disc].put(b, far_until_m);
      }

      next_m = least(next_m, far_until_m);
    }

    least_m_.put(b, least_m);
    enough_until_m_.put(b, is_wanted ? next_m : enough_until_m);
  }

  return any(is_near);
}

}  // namespace aisle::local_planner
