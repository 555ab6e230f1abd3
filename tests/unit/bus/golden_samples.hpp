#pragma once
#include <string>
#include <type_traits>
#include <utility>

#include "common/bus/topics.hpp"
#include "idl/fields.hpp"

namespace aisle::bus_test {

// One sample of each type with every field set to something of its own.
void fill(MapInfo& sample);
void fill(MapTile& sample);
void fill(MapRequest& sample);
void fill(MapEdit& sample);
void fill(MapEditResult& sample);
void fill(VehicleInfo& sample);
void fill(VehicleState& sample);
void fill(Scan& sample);
void fill(Goal& sample);
void fill(Plan& sample);
void fill(Track& sample);
void fill(TrackingStatus& sample);
void fill(Coverage& sample);
void fill(VelocityCommand& sample);
void fill(NavigationStatus& sample);
void fill(WorldObstacle& sample);
void fill(ServiceHealth& sample);

namespace detail {

template <class T, class = void>
struct IsText : std::false_type {};
template <class T>
struct IsText<T, std::void_t<decltype(std::declval<const T&>().to_string())>> : std::true_type {};
template <class T, class = void>
struct IsSequence : std::false_type {};
template <class T>
struct IsSequence<T, std::void_t<decltype(std::declval<T&>().begin())>> : std::true_type {};

/// Sets the field, and each field inside it, to something of its own; `count` goes on from field to field.
template <class Field>
void set(const char* name, Field& field, int& count) {
  ++count;
  if constexpr (std::is_same_v<Field, bool>) {
    field = true;
  } else if constexpr (std::is_arithmetic_v<Field>) {
    field = static_cast<Field>(count);
  } else if constexpr (std::is_enum_v<Field>) {
    field = static_cast<Field>(idl::words_of(Field{}).size() - 1);
  } else if constexpr (IsText<Field>::value) {
    field = std::string(name) + "-" + std::to_string(count);
  } else if constexpr (IsSequence<Field>::value) {
    if constexpr (!std::is_aggregate_v<Field>) field.resize(2);  // not an array
    for (auto& element : field) set(name, element, count);
  } else {
    idl::visit_fields(field, [&](const char* inner, auto& value) { set(inner, value, count); });
  }
}

}  // namespace detail

/// For a topic that has no sample of its own above: by the fields of its IDL.
template <class Sample>
void fill(Sample& sample) {
  int count = 0;
  idl::visit_fields(sample, [&](const char* name, auto& field) { detail::set(name, field, count); });
}

}  // namespace aisle::bus_test
