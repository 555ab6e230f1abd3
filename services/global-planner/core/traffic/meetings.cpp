#include "services/global-planner/core/traffic/meetings.hpp"

#include <algorithm>
#include <utility>

namespace aisle::global_planner::traffic {
namespace {

// Remembered pairs take some 50 bytes each; beyond this many all are forgotten, and judged again when asked for.
constexpr std::size_t kMostPairs = 1'000'000;
constexpr std::size_t kFewPairs = 9;  // of capsules

std::uint64_t key_of(std::uint32_t high, std::uint32_t low) { return (static_cast<std::uint64_t>(high) << 32U) | low; }

}  // namespace

ShapeId Meetings::add(const Shape& shape) {
  if (free_.empty()) {
    shapes_.push_back(shape);
    return static_cast<ShapeId>(shapes_.size() - 1);
  }
  const ShapeId number = free_.back();
  free_.pop_back();
  shapes_[number] = shape;
  return number;
}

void Meetings::end(ShapeId& number) {
  if (number != kNoId) ended_.push_back(number);
  number = kNoId;
}

void Meetings::forget(const std::vector<PlaceId>& places, const std::vector<MotionId>& motions) {
  for (const PlaceId id : places) {
    for (std::vector<ShapeId>* numbers : {&of_place_, &of_all_corners_})
      if (id < numbers->size()) end((*numbers)[id]);
  }
  for (const MotionId id : motions)
    if (id < of_motion_.size()) end(of_motion_[id]);

  if (motions.empty()) return;
  std::vector<MotionId> sorted = motions;
  std::sort(sorted.begin(), sorted.end());
  const auto has_ended = [&](MotionId id) { return std::binary_search(sorted.begin(), sorted.end(), id); };
  for (MotionId before = 0; before < of_corner_.size(); ++before) {
    auto& corners = of_corner_[before];
    if (corners.empty()) continue;
    const bool all_end = has_ended(before);
    const auto goes = [&](Corner& corner) {
      if (!all_end && !has_ended(corner.after)) return false;
      end(corner.shape);
      return true;
    };
    corners.erase(std::remove_if(corners.begin(), corners.end(), goes), corners.end());
  }
}

void Meetings::reuse_ended(const std::vector<bool>& is_used) {
  std::vector<ShapeId> kept;
  for (const ShapeId shape : ended_) {
    if (shape < is_used.size() && is_used[shape]) {
      kept.push_back(shape);
      continue;
    }
    shapes_[shape] = Shape();
    free_.push_back(shape);
  }
  ended_ = std::move(kept);
  known_pairs_.clear();
}

ShapeId Meetings::numbered(std::vector<ShapeId>& numbers, std::uint32_t id, const Shape& shape) {
  if (id >= numbers.size()) numbers.resize(std::max<std::size_t>(id + 1, 2 * numbers.size()), kNoId);
  if (numbers[id] == kNoId) numbers[id] = add(shape);
  return numbers[id];
}

ShapeId Meetings::of_place(PlaceId place) { return numbered(of_place_, place, roadmap_.place(place).standing); }

ShapeId Meetings::of_motion(MotionId motion) { return numbered(of_motion_, motion, roadmap_.motion(motion).shape); }

ShapeId Meetings::of_corner(MotionId before, MotionId after) {
  if (before >= of_corner_.size()) of_corner_.resize(std::max<std::size_t>(before + 1, 2 * of_corner_.size()));
  for (const Corner& corner : of_corner_[before])
    if (corner.after == after) return corner.shape;

  const Motion& first = roadmap_.motion(before);
  const auto& way_in = first.path_in_map;
  const auto& way_out = roadmap_.motion(after).path_in_map;
  const Kind& kind = roadmap_.kind(first.kind);
  ShapeId shape = kNoId;
  if (kind.turns_on_the_spot() && way_in.size() > 1 && way_out.size() > 1) {
    const Shape arc = roadmap_.zones().held(corner_shape(kind, way_in[way_in.size() - 2], way_out.front(), way_out[1]));
    if (!arc.empty()) shape = add(arc);
  }
  of_corner_[before].push_back({after, shape});
  return shape;
}

ShapeId Meetings::of_all_corners(PlaceId place) {
  if (place < of_all_corners_.size() && of_all_corners_[place] != kNoId) return of_all_corners_[place];

  const Place& here = roadmap_.place(place);
  const Shape shape = all_corners_shape(roadmap_.kind(here.kind), here.base_in_map.position());
  return shape.empty() ? kNoId : numbered(of_all_corners_, place, shape);
}

bool Meetings::meet(ShapeId a, ShapeId b) {
  if (a == b) return true;

  // Small shapes are judged sooner than they are looked up.
  if (shapes_[a].capsules().size() * shapes_[b].capsules().size() <= kFewPairs)
    return traffic::meet(shapes_[a], shapes_[b], gap_m_);

  if (known_pairs_.size() > kMostPairs) known_pairs_.clear();
  const auto [found, is_new] = known_pairs_.try_emplace(key_of(std::min(a, b), std::max(a, b)), false);
  if (is_new) found->second = traffic::meet(shapes_[a], shapes_[b], gap_m_);
  return found->second;
}

}  // namespace aisle::global_planner::traffic
