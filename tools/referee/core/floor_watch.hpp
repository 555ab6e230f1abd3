#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/geometry/body.hpp"
#include "tools/referee/core/authority_watch.hpp"
#include "tools/referee/core/closest_approach.hpp"

namespace aisle::referee {

/// Checks from what vehicles say they may still drive through that no floor is held by two of them: the floor of a
/// vehicle is where its outline stands, and where its outline comes along the poses up to its limit. What the leader of
/// the traffic believes counts for nothing, and no code is shared with its lock.
///
/// Words of two vehicles are from different moments, and may come late or not at all. Floor counts as held twice once
/// both vehicles have spoken again kLater_s after their floors were first seen to overlap, and they still do.
class FloorWatch {
 public:
  /// @param ahead_m of the shape's middle before the base
  void shape_seen(const std::string& agv_id, const Shape& shape, double ahead_m);

  /// The vehicle's word.
  /// @param held_in_map where it is, then where it turns on its way, up to its limit; empty: it says nothing of that
  void road_said(const std::string& agv_id, const std::vector<geometry::Pose2>& held_in_map, double t_s);

  /// In the order in which they began.
  const std::vector<AuthorityViolation>& violations() const { return violations_; }

  static constexpr double kLater_s = 1.0;
  static constexpr double kClearly_m = 0.05;  // floors that overlap by less only touch

 private:
  struct Holder {
    Shape shape;
    double ahead_m{0.0};
    std::vector<geometry::Body> floor;
    double said_s{0.0};
  };

  struct Overlap {
    double since_s{0.0};
    bool is_told{false};
  };

  static std::vector<geometry::Body> floor_along(const Holder& holder, const std::vector<geometry::Pose2>& held_in_map);

  /// A place where both floors are; none: they do not overlap.
  static const geometry::Body* shared(const Holder& a, const Holder& b);

  void judge(const std::string& a, const std::string& b, double t_s);

  std::map<std::string, Holder> holders_;
  std::map<std::pair<std::string, std::string>, Overlap> overlaps_;  // that go on
  std::vector<AuthorityViolation> violations_;
};

}  // namespace aisle::referee
