#pragma once
#include <string>

namespace aisle::bus_test {

/// docs/topics.md, made from common/bus/topics.hpp.
std::string topics_page();

}  // namespace aisle::bus_test
