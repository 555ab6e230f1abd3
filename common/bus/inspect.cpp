#include "common/bus/inspect.hpp"

#include <map>

#include "common/bus/type_table.hpp"

namespace aisle::bus {

std::string type_name(const std::string& topic) { return topic_type(topic).make_support().get_type_name(); }

std::size_t serialized_bytes(const std::string& topic, const void* sample) {
  static std::map<std::string, fast::dds::TypeSupport> supports;
  const auto [found, is_new] = supports.try_emplace(topic);
  if (is_new) found->second = topic_type(topic).make_support();
  return fast::serialized_bytes(found->second, sample);
}

}  // namespace aisle::bus
