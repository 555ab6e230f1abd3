#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/geometry/footprint.hpp"
#include "common/grid/clearance.hpp"

namespace aisle::lab {

/// What the judge is shown of a vehicle at one moment.
struct JudgedVehicle {
  std::string agv_id;
  geometry::Footprint footprint;
  geometry::Pose2 base_in_map;
  bool obeys{true};  // it is alive and does as it is told

  /// From where it is to its limit, and the same for a newer limit that was sent to it and may reach it any moment.
  std::vector<std::vector<geometry::Point2>> roads_in_map;

  /// All roads that were granted to it lately, whole: it must be on one of them.
  std::vector<std::vector<geometry::Point2>> granted_in_map;
};

/// Looks at a run from outside, by bodies and roads alone: it shares no code with shapes and lock.
///
///  - bodies of two vehicles never touch, and none touches a wall;
///  - a vehicle is never off the roads that were granted to it;
///  - the outlines along the roads of two vehicles never overlap: no floor is held twice.
class FloorJudge {
 public:
  explicit FloorJudge(const grid::ClearanceField& clearance) : clearance_(clearance) {}

  void look(double now_s, const std::vector<JudgedVehicle>& vehicles);

  /// The roads of these two are not compared any more: they began too near to each other.
  void except(const std::string& a, const std::string& b) { excepted_.insert({a < b ? a : b, a < b ? b : a}); }

  int contacts() const { return contacts_; }  // of two vehicles, each from its beginning to its end
  int wall_contacts() const { return wall_contacts_; }
  int off_road() const { return off_road_; }
  int held_twice() const { return held_twice_; }  // pairs of vehicles, each from its beginning to its end
  double least_clearance_m() const { return least_clearance_m_; }

  /// A line for each finding: when, who, where.
  const std::vector<std::string>& findings() const { return findings_; }

 private:
  using Pair = std::pair<std::string, std::string>;

  void judge_bodies(double now_s, const std::vector<JudgedVehicle>& vehicles);
  void judge_roads(double now_s, const std::vector<JudgedVehicle>& vehicles);
  void judge_places(double now_s, const std::vector<JudgedVehicle>& vehicles);
  void judge_walls(double now_s, const std::vector<JudgedVehicle>& vehicles);

  /// Counts a finding when it begins; `open` holds those that go on.
  void note(bool is_so, const Pair& pair, std::set<Pair>& open, int& count, const std::string& line);

  const grid::ClearanceField& clearance_;
  std::set<Pair> excepted_;
  std::set<Pair> touching_, in_walls_, off_, shared_;
  int contacts_{0}, wall_contacts_{0}, off_road_{0}, held_twice_{0};
  double least_clearance_m_{std::numeric_limits<double>::infinity()};
  std::vector<std::string> findings_;
};

}  // namespace aisle::lab
