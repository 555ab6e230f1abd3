#include "common/bus/inspect.hpp"

#include "common/bus/sample_codec.hpp"

namespace aisle::bus {

std::string type_name(const std::string& topic) { return sample_codec(topic).type_name(); }

std::size_t serialized_bytes(const std::string& topic, const void* sample) {
  return sample_codec(topic).encoded_bytes(sample);
}

}  // namespace aisle::bus
