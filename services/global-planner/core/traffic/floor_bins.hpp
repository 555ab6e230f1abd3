#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::global_planner::traffic {

/// Axis-aligned rectangle in map; `low` is the corner with the least x and y.
struct Box {
  geometry::Point2 low_in_map;
  geometry::Point2 high_in_map;
};

/// The box with `margin_m` more on each side.
inline Box grown(const Box& box, double margin_m) {
  return {{box.low_in_map.x - margin_m, box.low_in_map.y - margin_m},
          {box.high_in_map.x + margin_m, box.high_in_map.y + margin_m}};
}

/// Do the boxes have a point in common?
inline bool touch(const Box& a, const Box& b) {
  return a.low_in_map.x <= b.high_in_map.x && b.low_in_map.x <= a.high_in_map.x && a.low_in_map.y <= b.high_in_map.y &&
         b.low_in_map.y <= a.high_in_map.y;
}

/// Items with boxes, found again by box: the floor in squares of 2 m, each with the items whose boxes touch it.
template <class Item>
class FloorBins {
 public:
  void add(const Box& box, const Item& item) {
    each_bin(box, [&](std::int64_t bin) { bins_[bin].push_back({box, item}); });
  }

  /// @pre added with the same box
  void remove(const Box& box, const Item& item) {
    each_bin(box, [&](std::int64_t bin) {
      const auto found = bins_.find(bin);
      if (found == bins_.end()) return;

      auto& entries = found->second;
      entries.erase(std::remove_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.item == item; }),
                    entries.end());
      if (entries.empty()) bins_.erase(found);
    });
  }

  /// Calls `visit(item)` once for each item whose box touches `box`, in a fixed order. @pre `visit` changes no bins
  ///
  /// How: an item stands in several bins; it counts only in that which holds the lower left corner of what both boxes
  /// have in common.
  template <class Visit>
  void visit(const Box& box, Visit&& visit) const {
    each_bin(box, [&](std::int64_t bin) {
      const auto found = bins_.find(bin);
      if (found == bins_.end()) return;

      for (const Entry& entry : found->second) {
        if (!touch(entry.box, box)) continue;

        const int x = bin_of(std::max(entry.box.low_in_map.x, box.low_in_map.x));
        const int y = bin_of(std::max(entry.box.low_in_map.y, box.low_in_map.y));
        if (key(x, y) == bin) visit(entry.item);
      }
    });
  }

  void clear() { bins_.clear(); }

 private:
  static constexpr double kBinM = 2.0;

  struct Entry {
    Box box;
    Item item;
  };

  static int bin_of(double m) { return static_cast<int>(std::floor(m / kBinM)); }
  static std::int64_t key(int x, int y) {
    return static_cast<std::int64_t>((static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U) |
                                     static_cast<std::uint32_t>(y));
  }

  template <class Each>
  static void each_bin(const Box& box, Each&& each) {
    const int last_x = bin_of(box.high_in_map.x);
    const int last_y = bin_of(box.high_in_map.y);
    for (int y = bin_of(box.low_in_map.y); y <= last_y; ++y)
      for (int x = bin_of(box.low_in_map.x); x <= last_x; ++x) each(key(x, y));
  }

  std::unordered_map<std::int64_t, std::vector<Entry>> bins_;
};

}  // namespace aisle::global_planner::traffic
