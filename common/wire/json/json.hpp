#pragma once

// Samples as they came, for people and scripts, by the fields of the IDL and in their order, so that a new topic needs
// no code here. Enumerators are in lower case without their prefix, hashes hexadecimal text (a JSON number would lose
// digits). Numbers that are not finite become null when written.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "common/wire/codecs.hpp"
#include "common/wire/extras.hpp"
#include "common/wire/field_kind.hpp"
#include "common/wire/geometry.hpp"
#include "idl/fields.hpp"

namespace aisle::wire {

/// Keeps the order of the fields.
using Json = nlohmann::ordered_json;

namespace detail {
struct AnyVisit {
  template <class Field>
  void operator()(const char*, const Field&) const;
};
}  // namespace detail

/// Each field under its name in the IDL, then what the type's codec adds for people.
template <class Sample,
          class = decltype(idl::visit_fields(std::declval<const Sample&>(), std::declval<detail::AnyVisit>()))>
Json to_json(const Sample& sample);

inline Json to_json(const geometry::Pose2& pose_in_map) { return to_json(encode(pose_in_map)); }

namespace detail {

/// Counters are an object, by name.
Json json_of_field(const std::string& name, const std::vector<aisle::Counter>& counters);

/// 16 digits.
std::string hexadecimal(std::uint64_t value);

/// The word at the enumerator's place; its number when a newer program knows more of them.
std::string word_at(const std::vector<const char*>& words, std::int64_t index);

/// A whole number whose name has "hash" in it is hexadecimal.
template <class Field>
Json json_of_field(const std::string& name, const Field& field) {
  if constexpr (std::is_same_v<Field, bool> || std::is_floating_point_v<Field>) {
    return field;
  } else if constexpr (std::is_integral_v<Field>) {
    if (name.find("hash") != std::string::npos) return hexadecimal(static_cast<std::uint64_t>(field));
    return field;
  } else if constexpr (std::is_enum_v<Field>) {
    return word_at(idl::words_of(Field{}), static_cast<std::int64_t>(field));
  } else if constexpr (IsText<Field>::value) {
    return field.to_string();
  } else if constexpr (IsSequence<Field>::value) {
    Json array = Json::array();
    for (const auto& element : field) array.push_back(json_of_field(name, element));
    return array;
  } else {
    return to_json(field);
  }
}

}  // namespace detail

template <class Sample, class>
Json to_json(const Sample& sample) {
  Json json = Json::object();
  idl::visit_fields(sample,
                    [&](const char* name, const auto& field) { json[name] = detail::json_of_field(name, field); });
  for (const Extra& extra : extras_of(sample))
    std::visit([&](const auto& shown) { json[extra.name] = shown; }, extra.shown);
  return json;
}

/// A value as `aisle topic echo` shows it: as JSON of the sample that it is written as, with its origin.
template <class Value>
Json json_of(const Value& value, const fleet::Origin& by) {
  auto sample = encode(value);
  stamp(sample, by);
  return to_json(sample);
}

/// One line. What came over the wire may not be UTF-8; such bytes are replaced.
std::string write_json(const Json& json);

}  // namespace aisle::wire
