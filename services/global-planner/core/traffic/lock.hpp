#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "services/global-planner/core/traffic/shape.hpp"

namespace aisle::global_planner::traffic {

/// Who holds which part of the floor. Shapes of two vehicles that were admitted never meet; nothing else is decided
/// here: no search, no clock.
///
/// A vehicle's shapes are numbered by its steps, counted from its registration. A shape is held from its admission
/// until `release` with a step beyond it.
class Lock {
 public:
  /// The step under which held() tells a forced shape.
  static constexpr std::uint64_t kForced = ~std::uint64_t{0};

  /// @param gap_m shapes nearer to each other than this meet
  explicit Lock(double gap_m);

  /// Holds the shape for the vehicle if it meets no shape of another vehicle; else changes nothing and returns false.
  /// What the vehicle holds under that step already stays held. @pre step < kForced
  bool admit(const std::string& agv_id, std::uint64_t step, const Shape& shape);

  /// Holds under that step, too, what the vehicle holds under another one. Nobody is asked: no floor becomes its own
  /// that was not. Returns false and changes nothing unless each capsule lies inside one that the vehicle was admitted
  /// to.
  /// @pre step < kForced
  bool keep(const std::string& agv_id, std::uint64_t step, const Shape& part);

  /// Vehicles whose shapes keep this one from being admitted, in the order of their ids.
  std::vector<std::string> holders(const std::string& agv_id, const Shape& shape) const;

  /// Holds the shape whatever it meets: the body of a vehicle that strays, has just joined, or does not obey. It takes
  /// the place of the vehicle's earlier forced shape; an empty one ends it.
  void force(const std::string& agv_id, const Shape& shape);

  /// The vehicle reports that it is behind all steps before `step`. Earlier numbers than before change nothing.
  void release(const std::string& agv_id, std::uint64_t step);

  /// Steps from `step` on were given back with the vehicle's word.
  void give_back(const std::string& agv_id, std::uint64_t step);

  /// The two stand too near to each other from the beginning: their shapes do not count against each other until they
  /// are apart. One may move, the other holds: that is the caller's to see to.
  void except(const std::string& a, const std::string& b);
  void end_exception(const std::string& a, const std::string& b);

  /// Everything that the vehicle holds ends: it was signed off.
  void forget(const std::string& agv_id);

  /// All shapes that the vehicle holds, by step; the forced one under kForced. Good until the next change.
  const std::map<std::uint64_t, Shape>& held(const std::string& agv_id) const;

 private:
  /// A shape that is held: whose, and under which step. The id is a key of held_.
  struct Hold {
    const std::string* agv_id{nullptr};
    std::uint64_t step{0};
  };
  friend bool operator==(const Hold& a, const Hold& b) { return a.agv_id == b.agv_id && a.step == b.step; }

  using Steps = std::map<std::uint64_t, Shape>;

  bool is_excepted(const std::string& a, const std::string& b) const;

  /// Calls `visit(agv_id)` for each held shape of another vehicle that the shape meets, until it returns false.
  template <class Visit>
  void each_meeting(const std::string& agv_id, const Shape& shape, Visit&& visit) const;

  void hold(const std::string& agv_id, std::uint64_t step, const Shape& shape);

  /// Ends all holds from the one to before the other.
  void drop(const std::string& agv_id, std::uint64_t from_step, std::uint64_t to_step);
  void drop_forced(const std::string& agv_id);

  double gap_m_;
  std::map<std::string, Steps> held_;
  std::set<std::pair<std::string, std::string>> excepted_;  // the lesser id first
  FloorBins<Hold> bins_;
};

}  // namespace aisle::global_planner::traffic
