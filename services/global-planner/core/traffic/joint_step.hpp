#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "services/global-planner/core/traffic/meetings.hpp"
#include "services/global-planner/core/traffic/roadmap.hpp"

namespace aisle::global_planner::traffic {

/// What a vehicle does in a step of all vehicles: it drives a motion, or stays (`motion` is kNoId).
struct Move {
  MotionId motion{kNoId};
  PlaceId from{kNoId};
  PlaceId to{kNoId};
  MotionId before{kNoId};  // the motion that brought it to `from`; its corner with this one counts

  bool stays() const { return motion == kNoId; }
};

/// One step of all vehicles at once: PIBT (priority inheritance with backtracking, after Okumura et al. 2022), with
/// shapes that meet instead of equal cells.
///
/// Two moves go together when one of them can be driven after the other: whoever is in the way has left before, and
/// nobody has arrived in the way. These who-before-whom of all moves lead in no circle; so a full ring of vehicles
/// never turns at once.
class JointStep {
 public:
  /// @param obstacles shapes that no move may meet
  JointStep(Meetings& meetings, const std::vector<ShapeId>& obstacles) : meetings_(meetings), obstacles_(obstacles) {}

  /// Begins a step in which nobody has a move yet. @param places where each vehicle stands
  /// @param before the motions that brought them there
  void begin(const std::vector<PlaceId>& places, const std::vector<MotionId>& before);

  /// The vehicle shall make this move. False, and nothing changed: it does not go together with those before.
  bool prescribe(std::size_t vehicle, const Move& move);

  /// Gives the vehicle the first of its moves that goes together with all others, and moves to those that are in its
  /// way. @param wishes for each vehicle its moves, the best first, staying among them
  bool choose(std::size_t vehicle, const std::vector<std::vector<Move>>& wishes);

  bool has_move(std::size_t vehicle) const { return moves_[vehicle].has_value(); }

  /// The moves in an order in which they can be driven one after the other. @pre all vehicles have moves
  std::vector<std::size_t> order() const;
  const Move& move(std::size_t vehicle) const { return *moves_[vehicle]; }

 private:
  bool goes_together(const Move& move);
  bool touches(const Move& move, ShapeId shape);
  bool meets_obstacle(const Move& move);
  bool leads_in_circle(std::size_t vehicle) const;
  void give(std::size_t vehicle, const Move& move);
  void take_back(std::size_t count);
  bool clear_way(std::size_t vehicle, const std::vector<std::vector<Move>>& wishes);

  Meetings& meetings_;
  const std::vector<ShapeId>& obstacles_;

  std::vector<PlaceId> places_;
  std::vector<MotionId> before_;
  std::vector<std::optional<Move>> moves_;
  std::vector<std::size_t> given_;                // vehicles with moves, in the order in which they got them
  std::vector<std::vector<std::size_t>> firsts_;  // for each vehicle those that must go before it
  std::vector<std::size_t> new_firsts_;           // of the move that was judged last
  std::vector<std::size_t> new_laters_;
};

}  // namespace aisle::global_planner::traffic
