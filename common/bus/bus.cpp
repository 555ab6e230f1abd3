#include "common/bus/bus.hpp"

namespace aisle::bus {

Bus::~Bus() = default;

void Bus::run_until(const std::atomic<bool>& stop) {
  while (!stop) run_once(std::chrono::milliseconds(100));
}

std::vector<std::string> Bus::participants() const {
  std::vector<std::string> names;
  for (const Participant& peer : peers()) names.push_back(peer.name);
  return names;
}

}  // namespace aisle::bus
