#include "services/local-planner/core/plain_walls.hpp"

#include <algorithm>
#include <limits>

#include "services/local-planner/core/walls.hpp"

namespace aisle::local_planner::plain {

using geometry::kBatch;

Walls::Walls(const Scene& scene, const DiscGaps& gaps_m, double enough_m)
    : scene_(scene), rough_(scene.clearance), enough_m_(enough_m) {
  Watched watched;
  watched.enough_until_m = *std::min_element(gaps_m.begin(), gaps_m.end()) - enough_m;
  watched.least_m = enough_m;
  for (std::size_t disc = 0; disc < kMostDiscs; ++disc) watched.far_until_m[disc] = gaps_m[disc] - enough_m;
  watched_.assign(kBlock, watched);
}

geometry::Point2 Walls::center_in_map(const Arc<double>& arc, std::size_t disc) const {
  if (is_disc(scene_)) return {arc.x, arc.y};
  const double ahead_m = scene_.discs_ahead_m[disc];
  return {arc.x + ahead_m * arc.cos_yaw(), arc.y + ahead_m * arc.sin_yaw()};
}

void Walls::look(const std::vector<Arc<double>>& arcs, const std::vector<double>& driven_m) {
  for (std::size_t i = 0; i < kBlock; ++i) watched_[i].driven_m += driven_m[i];

  for (std::size_t first = 0; first < kBlock; first += kBatch) {
    const bool is_due = std::any_of(&watched_[first], &watched_[first] + kBatch,
                                    [](const Watched& it) { return !it.is_left && it.driven_m > it.enough_until_m; });
    if (is_due) look_at_four(&watched_[first], &arcs[first]);
  }
}

void Walls::look_at_four(Watched* four, const Arc<double>* arcs) {
  const bool is_near_already =
      std::any_of(four, four + kBatch, [&](const Watched& it) { return !it.is_left && it.least_m < enough_m_; });

  std::array<double, kBatch> next_m;
  next_m.fill(std::numeric_limits<double>::infinity());

  for (std::size_t disc = 0; disc < scene_.discs_ahead_m.size(); ++disc) {
    const bool is_due = std::any_of(
        four, four + kBatch, [&](const Watched& it) { return !it.is_left && it.driven_m > it.far_until_m[disc]; });
    if (is_due) look_up(four, arcs, disc, is_near_already);
    for (std::size_t i = 0; i < kBatch; ++i) next_m[i] = std::min(next_m[i], four[i].far_until_m[disc]);
  }

  for (std::size_t i = 0; i < kBatch; ++i) four[i].enough_until_m = next_m[i];
}

/// First roughly; exactly where the rough bound of one of the four is not enough.
void Walls::look_up(Watched* four, const Arc<double>* arcs, std::size_t disc, bool is_near_already) {
  std::array<double, kBatch> gap_m;

  bool is_rough_enough = !is_near_already;
  for (std::size_t i = 0; i < kBatch && is_rough_enough; ++i) {
    gap_m[i] = rough_.rough_m(center_in_map(arcs[i], disc)) - scene_.radius_m;
    is_rough_enough = four[i].is_left || gap_m[i] >= four[i].least_m;
  }

  for (std::size_t i = 0; i < kBatch; ++i) {
    Watched& it = four[i];
    if (it.is_left) continue;
    if (!is_rough_enough) gap_m[i] = scene_.clearance.clearance_m(center_in_map(arcs[i], disc)) - scene_.radius_m;

    it.least_m = std::min(it.least_m, gap_m[i]);
    it.far_until_m[disc] = it.driven_m + (gap_m[i] - it.least_m);
  }
}

}  // namespace aisle::local_planner::plain
