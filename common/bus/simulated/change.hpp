#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/bus/sample_codec.hpp"

namespace aisle::bus::simulated {

/// The instance of a topic that a sample belongs to. Readers take instance by instance in the order of these, as Fast
/// DDS does in the order of hashes of keys: the order of arrival holds within an instance only.
struct InstanceId {
  std::uint64_t hash{0};  // of the key
  int number{-1};         // in order of first use, from 0; -1 on queues, whose keys are used once
};

inline bool operator==(const InstanceId& a, const InstanceId& b) { return a.hash == b.hash && a.number == b.number; }

inline bool operator<(const InstanceId& a, const InstanceId& b) {
  return a.hash != b.hash ? a.hash < b.hash : a.number < b.number;
}

/// What a writer said: a sample's bytes, or the end of an instance. Made once, shared by all readers.
struct Change {
  std::uint64_t sequence;  // of its writer, from 1
  InstanceId instance;     // that the sample belongs to
  bool disposed;           // then `bytes` hold a sample of which only the key fields matter
  std::vector<std::uint8_t> bytes;
  mutable AnySample decoded{};  // from the bytes, by the first reader that asks (see sample_of): readers only read it
  mutable bool is_malformed{false};
};

using ChangePtr = std::shared_ptr<const Change>;

}  // namespace aisle::bus::simulated
