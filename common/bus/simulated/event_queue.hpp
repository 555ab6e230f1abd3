#pragma once
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "common/time/stamp.hpp"

namespace aisle::bus::simulated {

/// What will happen when: by time, and for equal times in the order of pushing. A heap of small entries; the actions
/// stay where they are.
class EventQueue {
 public:
  using Action = std::function<void()>;

  void push(time::Stamp time, Action action);
  bool empty() const { return heap_.empty(); }
  /// @pre !empty()
  time::Stamp next_time() const { return heap_.front().time; }
  /// Takes the next action out. @pre !empty()
  Action pop();

 private:
  struct Entry {
    time::Stamp time;
    std::uint64_t order;
    std::size_t slot;
  };
  static bool is_later(const Entry& a, const Entry& b) {
    return std::pair(a.time, a.order) > std::pair(b.time, b.order);
  }
  std::vector<Entry> heap_;
  std::vector<Action> actions_;      // by slot
  std::vector<std::size_t> unused_;  // slots
  std::uint64_t order_{0};
};

}  // namespace aisle::bus::simulated
