#pragma once
#include <cstdint>
#include <memory>
#include <vector>

namespace aisle::bus::simulated {

/// What a writer said: a sample's bytes, or the end of an instance. Made once, shared by all readers.
struct Change {
  std::uint64_t sequence;  // of its writer, from 1
  int instance;            // of the topic's keys, see Topic::instance_of; -1 on queues
  bool disposed;           // then `bytes` hold a sample of which only the key fields matter
  std::vector<std::uint8_t> bytes;
};
using ChangePtr = std::shared_ptr<const Change>;

}  // namespace aisle::bus::simulated
