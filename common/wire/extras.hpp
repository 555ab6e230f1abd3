#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace aisle::wire {

/// What people see of a sample beside its fields: a number, or the rows of a picture, under a name of its own.
struct Extra {
  std::string name;
  std::variant<std::int64_t, std::vector<std::string>> shown;
};

using Extras = std::vector<Extra>;

/// None, unless the header of the type's codec declares an overload for it.
template <class Sample>
Extras extras_of(const Sample&) {
  return {};
}

}  // namespace aisle::wire
