#pragma once
// One sample of each topic, kept as the bytes that are on the wire: tests/data/cdr/<topic>.hex. Every field has
// something of its own.
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "common/bus/sample_codec.hpp"
#include "common/bus/topics.hpp"

namespace aisle::bus_test {

using Bytes = std::vector<std::uint8_t>;

/// tests/data/cdr/<topic>.hex; `ending` "json": what its fields are.
std::filesystem::path golden_file(const std::string& topic, const std::string& ending = "hex");
/// Sixteen bytes a line.
std::string hex(const Bytes& bytes);
/// Empty without a file.
Bytes read_golden_bytes(const std::string& topic);

/// The name of the topic with samples of this type.
template <class Sample>
std::string topic_of() {
  std::string name;
  topics::for_each(topics::All{}, [&](auto topic) {
    if constexpr (std::is_same_v<typename decltype(topic)::Sample, Sample>) name = decltype(topic)::kName;
  });
  return name;
}

template <class Sample>
Sample golden_sample() {
  const std::string topic = topic_of<Sample>();
  Sample sample;
  if (!bus::sample_codec(topic).decode(read_golden_bytes(topic), &sample))
    throw std::runtime_error(golden_file(topic).string() + " is missing, or holds no sample of this topic");
  return sample;
}

}  // namespace aisle::bus_test
