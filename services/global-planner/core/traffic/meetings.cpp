#include "services/global-planner/core/traffic/meetings.hpp"

#include <algorithm>

namespace aisle::global_planner::traffic {
namespace {

// Remembered pairs take some 50 bytes each; beyond this many all are forgotten, and judged again when asked for.
constexpr std::size_t kMostPairs = 4'000'000;

std::uint64_t key_of(std::uint32_t high, std::uint32_t low) { return (static_cast<std::uint64_t>(high) << 32U) | low; }

}  // namespace

ShapeId Meetings::add(const Shape& shape) {
  shapes_.push_back(shape);
  return static_cast<ShapeId>(shapes_.size() - 1);
}

ShapeId Meetings::numbered(std::vector<ShapeId>& numbers, std::uint32_t id, const Shape& shape) {
  if (id >= numbers.size()) numbers.resize(std::max<std::size_t>(id + 1, 2 * numbers.size()), kNoId);
  if (numbers[id] == kNoId) numbers[id] = add(shape);
  return numbers[id];
}

ShapeId Meetings::of_place(PlaceId place) { return numbered(of_place_, place, roadmap_.place(place).standing); }

ShapeId Meetings::of_motion(MotionId motion) { return numbered(of_motion_, motion, roadmap_.motion(motion).shape); }

ShapeId Meetings::of_corner(MotionId before, MotionId after) {
  const Motion& first = roadmap_.motion(before);
  const Kind& kind = roadmap_.kind(first.kind);
  if (!kind.turns_on_the_spot()) return kNoId;

  const auto [found, is_new] = of_corner_.try_emplace(key_of(before, after), kNoId);
  if (!is_new) return found->second;

  const auto& way_in = first.path_in_map;
  const auto& way_out = roadmap_.motion(after).path_in_map;
  if (way_in.size() < 2 || way_out.size() < 2) return kNoId;

  const Shape arc = corner_shape(kind, way_in[way_in.size() - 2], way_out.front(), way_out[1]);
  if (!arc.empty()) found->second = add(arc);
  return found->second;
}

bool Meetings::meet(ShapeId a, ShapeId b) {
  if (a == b) return true;

  if (known_pairs_.size() > kMostPairs) known_pairs_.clear();
  const auto [found, is_new] = known_pairs_.try_emplace(key_of(std::min(a, b), std::max(a, b)), false);
  if (is_new) found->second = traffic::meet(shapes_[a], shapes_[b], gap_m_);
  return found->second;
}

}  // namespace aisle::global_planner::traffic
