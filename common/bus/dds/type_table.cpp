#include "common/bus/dds/type_table.hpp"

#include <cassert>
#include <cstdlib>
#include <tuple>
#include <type_traits>

#include "common/bus/topics.hpp"
#include "idl/supports.hpp"

namespace aisle::bus {
namespace {

/// A key field as bytes that tell where it ends.
template <class Field>
void append_field(const Field& field, std::string& bytes) {
  if constexpr (std::is_arithmetic_v<Field>) {
    bytes.append(reinterpret_cast<const char*>(&field), sizeof field);
  } else {
    bytes.append(field.c_str()).push_back('\0');
  }
}

/// Topic: a row of topics.hpp; Generated: the type support that fastddsgen made for its sample.
template <class Topic, class Generated>
TopicType row() {
  static_assert(std::is_same_v<typename Topic::Sample, typename Generated::type>);

  using Sample = typename Topic::Sample;
  return {Topic::kName, Topic::kQos, [] { return fast::dds::TypeSupport(new fast::Guarded<Generated>); },
          [](void* to, void* from) { Topic::key(*static_cast<Sample*>(to)) = Topic::key(*static_cast<Sample*>(from)); },
          [](void* sample, std::string& bytes) {
            std::apply([&](const auto&... fields) { (append_field(fields, bytes), ...); },
                       Topic::key(*static_cast<Sample*>(sample)));
          }};
}

template <class... Topics>
std::vector<TopicType> rows_of(topics::List<Topics...>) {
  return {
      row<Topics,
          std::remove_pointer_t<decltype(idl::support_of(static_cast<const typename Topics::Sample*>(nullptr)))>>()...};
}

const std::vector<TopicType>& table() {
  static const std::vector<TopicType> rows = rows_of(topics::All{});
  return rows;
}

}  // namespace

const std::vector<TopicType>& all_topic_types() { return table(); }

const TopicType& topic_type(const std::string& topic) {
  for (const TopicType& row : table()) {
    if (topic == row.name) return row;
  }

  assert(false && "not in topics.hpp");
  std::abort();
}

}  // namespace aisle::bus
