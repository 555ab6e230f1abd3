#include "common/wire/json/json.hpp"

#include <cstddef>
#include <cstdio>

namespace aisle::wire {

namespace detail {

std::string hexadecimal(std::uint64_t value) {
  char text[19];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(value));
  return text;
}

std::string word_at(const std::vector<const char*>& words, std::int64_t index) {
  const bool is_known = index >= 0 && index < static_cast<std::int64_t>(words.size());
  return is_known ? words[static_cast<std::size_t>(index)] : std::to_string(index);
}

Json json_of_field(const std::string&, const std::vector<aisle::Counter>& counters) {
  Json json = Json::object();

  for (const aisle::Counter& counter : counters) json[counter.name().to_string()] = counter.value();

  return json;
}

}  // namespace detail

std::string write_json(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace aisle::wire
