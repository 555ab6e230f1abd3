#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "common/time/stamp.hpp"

namespace aisle::bus::simulated {

/// Future actions in order of time; those for the same time in the order of pushing. A binary heap of
/// small entries; the actions themselves stay where they are.
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
  /// `slot`: place of its action in actions_.
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
