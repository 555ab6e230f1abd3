#include "python/native/arguments.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/config/reader.hpp"

namespace aisle::python {

lab::Place place_of(const std::string& what, const std::vector<double>& numbers) {
  for (const double number : numbers)
    if (!std::isfinite(number)) throw config::BadInput(what + ": is not finite");
  if (numbers.size() == 3) return {{numbers[0], numbers[1]}, numbers[2]};
  if (numbers.size() == 2) return {{numbers[0], numbers[1]}};
  throw config::BadInput(what + ": give x, y or x, y, yaw");
}

double within(const std::string& what, double value, double least, double most) {
  // Also refuses what is not a number, which compares with nothing.
  if (value >= least && value <= most) return value;
  throw config::BadInput(fmt::format("{} = {:g} is not within {:g} and {:g}", what, value, least, most));
}

std::vector<lab::ParameterValue> values_of(const Texts& texts, lab::Side side, const std::string& planner) {
  std::vector<lab::ParameterValue> values;
  for (const auto& [name, text] : texts) {
    const bool is_bare = name.find('.') == std::string::npos;
    values.push_back(is_bare ? lab::parse_parameter("parameters", planner + "." + name + "=" + text, side)
                             : lab::parse_parameter("parameters", name + "=" + text));
  }

  return values;
}

}  // namespace aisle::python
