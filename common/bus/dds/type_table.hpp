#pragma once

#include <string>
#include <vector>

#include "common/bus/dds/fastdds_compat.hpp"
#include "common/bus/qos.hpp"

namespace aisle::bus {

/// What the bus must know of a topic without knowing its C++ type.
struct TopicType {
  const char* name;
  Qos qos;

  fast::dds::TypeSupport (*make_support)();
  void (*copy_key)(void* to, void* from);
  void (*append_key)(void* sample, std::string& bytes);  // equal for equal keys, and only for these
};

/// One row for each topic of topics.hpp, in its order.
const std::vector<TopicType>& all_topic_types();

/// The row of topics.hpp with this name. @pre there is one
const TopicType& topic_type(const std::string& topic);

}  // namespace aisle::bus
