#pragma once

// For tools that measure what is said, without knowing the middleware.

#include <cstddef>
#include <string>

namespace aisle::bus {

/// Name of the topic's type as it is announced on the wire, "aisle::Plan". @pre `topic` is in
/// topics.hpp
std::string type_name(const std::string& topic);

/// Size of the payload when written, without headers. @pre `topic` is in topics.hpp, `sample` is of its type
std::size_t serialized_bytes(const std::string& topic, const void* sample);

}  // namespace aisle::bus
