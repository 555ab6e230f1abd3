#pragma once

// What a topic's samples are in our own types: the value by its codec in common/wire, the key by its row in
// common/bus/topics.hpp.

#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "common/bus/topics.hpp"
#include "common/wire/codecs.hpp"

namespace aisle::service {

/// The value that wire::decode() makes of a sample of this topic, e.g. fleet::MapEdit of topics::MapEdit.
template <class Topic>
using ValueOf = std::decay_t<decltype(*wire::decode(std::declval<const typename Topic::Sample&>()))>;

namespace detail {

/// A key's field as a type of ours.
template <class Field>
auto plain(const Field& field) {
  if constexpr (std::is_arithmetic_v<Field>) {
    return field;
  } else {
    return field.to_string();  // bounded strings of the IDL
  }
}

template <class... Fields>
auto plain_key(const std::tuple<Fields...>& fields) {
  if constexpr (sizeof...(Fields) == 1) {
    return plain(std::get<0>(fields));
  } else {
    return std::apply([](const auto&... field) { return std::make_tuple(plain(field)...); }, fields);
  }
}

}  // namespace detail

/// The key of a sample's instance: a std::string or a number; a std::tuple of them where the key has several fields.
template <class Topic>
auto key_of(const typename Topic::Sample& sample) {
  return detail::plain_key(Topic::key(const_cast<typename Topic::Sample&>(sample)));  // only read here
}

template <class Topic>
using KeyOf = decltype(key_of<Topic>(std::declval<const typename Topic::Sample&>()));

/// A sample of which only the key fields are set.
template <class Topic>
typename Topic::Sample sample_of_key(const KeyOf<Topic>& key) {
  typename Topic::Sample sample;

  if constexpr (std::tuple_size_v<decltype(Topic::key(sample))> == 1) {
    std::get<0>(Topic::key(sample)) = key;
  } else {
    Topic::key(sample) = key;
  }

  return sample;
}

}  // namespace aisle::service
