#include "services/global-planner/core/traffic/joint_step.hpp"

#include <algorithm>

namespace aisle::global_planner::traffic {

void JointStep::begin(const std::vector<PlaceId>& places, const std::vector<MotionId>& before) {
  places_ = places;
  before_ = before;
  moves_.assign(places.size(), std::nullopt);
  given_.clear();
  firsts_.assign(places.size(), {});
}

/// Does the floor of the move meet the shape?
bool JointStep::touches(const Move& move, ShapeId shape) {
  if (move.stays()) return meetings_.meet(meetings_.of_place(move.from), shape);
  if (meetings_.meet(meetings_.of_motion(move.motion), shape)) return true;

  const ShapeId corner = move.before == kNoId ? kNoId : meetings_.of_corner(move.before, move.motion);
  return corner != kNoId && meetings_.meet(corner, shape);
}

bool JointStep::meets_obstacle(const Move& move) {
  return std::any_of(obstacles_.begin(), obstacles_.end(), [&](ShapeId shape) { return touches(move, shape); });
}

/// Judges the move against all that have been given; notes who must go before and after it.
bool JointStep::goes_together(const Move& move) {
  new_firsts_.clear();
  new_laters_.clear();
  const ShapeId begin = meetings_.of_place(move.from);
  const ShapeId end = meetings_.of_place(move.to);

  for (const std::size_t other : given_) {
    const Move& theirs = *moves_[other];
    const ShapeId their_begin = meetings_.of_place(theirs.from);
    const ShapeId their_end = meetings_.of_place(theirs.to);
    if (meetings_.meet(end, their_end)) return false;

    const bool other_first = (!move.stays() && touches(move, their_begin)) || (!theirs.stays() && touches(theirs, end));
    const bool other_later = (!theirs.stays() && touches(theirs, begin)) || (!move.stays() && touches(move, their_end));
    if (other_first && other_later) return false;
    if (other_first) new_firsts_.push_back(other);
    if (other_later) new_laters_.push_back(other);
  }
  return true;
}

void JointStep::give(std::size_t vehicle, const Move& move) {
  moves_[vehicle] = move;
  given_.push_back(vehicle);
  firsts_[vehicle] = new_firsts_;
  for (const std::size_t later : new_laters_) firsts_[later].push_back(vehicle);
}

/// The last `given_.size() - count` vehicles have no move any more.
void JointStep::take_back(std::size_t count) {
  while (given_.size() > count) {
    const std::size_t vehicle = given_.back();
    given_.pop_back();
    moves_[vehicle].reset();
    firsts_[vehicle].clear();
    for (const std::size_t other : given_) {
      auto& firsts = firsts_[other];
      firsts.erase(std::remove(firsts.begin(), firsts.end(), vehicle), firsts.end());
    }
  }
}

/// Must the vehicle go before itself?
bool JointStep::leads_in_circle(std::size_t vehicle) const {
  std::vector<std::size_t> to_look_at = firsts_[vehicle];
  std::vector<bool> is_known(moves_.size(), false);
  while (!to_look_at.empty()) {
    const std::size_t next = to_look_at.back();
    to_look_at.pop_back();
    if (next == vehicle) return true;
    if (is_known[next]) continue;

    is_known[next] = true;
    to_look_at.insert(to_look_at.end(), firsts_[next].begin(), firsts_[next].end());
  }
  return false;
}

bool JointStep::prescribe(std::size_t vehicle, const Move& move) {
  if ((!move.stays() && meets_obstacle(move)) || !goes_together(move)) return false;

  const std::size_t count = given_.size();
  give(vehicle, move);
  if (!leads_in_circle(vehicle)) return true;
  take_back(count);
  return false;
}

/// Vehicles without a move that stand in the way of this one's get moves away.
bool JointStep::clear_way(std::size_t vehicle, const std::vector<std::vector<Move>>& wishes) {
  const Move move = *moves_[vehicle];
  if (move.stays()) return true;

  for (std::size_t other = 0; other < places_.size(); ++other) {
    if (moves_[other] || !touches(move, meetings_.of_place(places_[other]))) continue;
    if (!choose(other, wishes)) return false;
  }
  return true;
}

bool JointStep::choose(std::size_t vehicle, const std::vector<std::vector<Move>>& wishes) {
  const std::size_t count = given_.size();
  for (const Move& wish : wishes[vehicle]) {
    if (!prescribe(vehicle, wish)) continue;
    if (clear_way(vehicle, wishes)) return true;
    take_back(count);
  }
  return false;
}

/// How: depth first; a vehicle stands behind all that must go before it.
std::vector<std::size_t> JointStep::order() const {
  std::vector<std::size_t> out;
  std::vector<int> state(moves_.size(), 0);  // 1: its firsts are being put in, 2: is in the order
  for (std::size_t root = 0; root < moves_.size(); ++root) {
    std::vector<std::size_t> stack{root};
    while (!stack.empty()) {
      const std::size_t vehicle = stack.back();
      if (state[vehicle] == 0) {
        state[vehicle] = 1;
        for (const std::size_t first : firsts_[vehicle])
          if (state[first] == 0) stack.push_back(first);
        continue;
      }
      stack.pop_back();
      if (state[vehicle] == 1) out.push_back(vehicle);
      state[vehicle] = 2;
    }
  }
  return out;
}

}  // namespace aisle::global_planner::traffic
