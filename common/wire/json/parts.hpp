#pragma once
// Pieces that the to_json functions share.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

#include "common/wire/json/json.hpp"

namespace aisle::wire {

/// The name at the enumerator's place; its number when a newer program knows more of them.
template <std::size_t N, class Enum>
std::string enumerator_name(const std::array<const char*, N>& names, Enum value) {
  const auto index = static_cast<std::int64_t>(value);
  return index >= 0 && index < static_cast<std::int64_t>(N) ? names[static_cast<std::size_t>(index)]
                                                            : std::to_string(index);
}

inline std::string hexadecimal(std::uint64_t value) {
  char text[19];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(value));
  return text;
}

template <class Sequence>
Json array_of(const Sequence& sequence) {
  Json array = Json::array();
  for (const auto& element : sequence) array.push_back(to_json(element));
  return array;
}

}  // namespace aisle::wire
