#pragma once
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "common/wire/field_kind.hpp"
#include "idl/fields.hpp"

namespace aisle::bus_test {

namespace detail {

inline bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Sets the field, and each field inside it, to something of its own that a decoder is likely to accept; `count` goes
/// on from field to field. Numbers that are not whole are multiples of 1/64, below 2 in most types. What is counted in
/// cells is 2, and a sequence of octets has a value for each of 2 x 2 cells.
template <class Field>
void set(const char* name, Field& field, int& count) {
  ++count;
  if constexpr (std::is_same_v<Field, bool>) {
    field = true;
  } else if constexpr (std::is_floating_point_v<Field>) {
    field = static_cast<Field>(count) / 64;
  } else if constexpr (std::is_integral_v<Field>) {
    field = ends_with(name, "_cells") ? Field{2} : static_cast<Field>(count);
  } else if constexpr (std::is_enum_v<Field>) {
    field = static_cast<Field>(idl::words_of(Field{}).size() - 1);
  } else if constexpr (wire::IsText<Field>::value) {
    field = std::string(name) + "-" + std::to_string(count);
  } else if constexpr (wire::IsSequence<Field>::value) {
    if constexpr (!std::is_aggregate_v<Field>)  // no array
      field.resize(std::is_same_v<Field, std::vector<std::uint8_t>> ? 4 : 2);
    for (auto& element : field) set(name, element, count);
  } else {
    idl::visit_fields(field, [&](const char* inner, auto& value) { set(inner, value, count); });
  }
}

}  // namespace detail

/// By the fields of its IDL: what a new topic's golden bytes are made of.
template <class Sample>
Sample filled_sample() {
  Sample sample;
  int count = 0;
  idl::visit_fields(sample, [&](const char* name, auto& field) { detail::set(name, field, count); });
  return sample;
}

}  // namespace aisle::bus_test
