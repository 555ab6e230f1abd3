#include "common/bus/simulated/event_queue.hpp"

#include <algorithm>

namespace aisle::bus::simulated {

/// A slot of an action that is done is used again.
void EventQueue::push(time::Stamp time, Action action) {
  std::size_t slot = actions_.size();
  if (unused_.empty()) {
    actions_.push_back(std::move(action));
  } else {
    slot = unused_.back();
    unused_.pop_back();
    actions_[slot] = std::move(action);
  }

  heap_.push_back({time, order_++, slot});
  std::push_heap(heap_.begin(), heap_.end(), is_later);
}

/// The slot is free at once, even while the action runs.
EventQueue::Action EventQueue::pop() {
  std::pop_heap(heap_.begin(), heap_.end(), is_later);

  const std::size_t slot = heap_.back().slot;
  heap_.pop_back();
  unused_.push_back(slot);

  return std::exchange(actions_[slot], nullptr);
}

}  // namespace aisle::bus::simulated
