#include "tools/cli/coordinates.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

#include "common/config/reader.hpp"

namespace aisle::cli {
namespace {

constexpr double kFarthestM = 1e6;   // of a coordinate
constexpr double kLargestM = 100.0;  // of a vehicle's length or width

/// Finite numbers between commas; blanks before a number are left out.
std::vector<double> split_numbers(const std::string& what, const std::string& text, const std::string& example) {
  const auto fail = [&](const std::string& why) {
    throw config::BadInput(what + ": '" + text + "' " + why + "; write e.g. " + example);
  };

  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    while (begin < end && text[begin] == ' ') ++begin;

    double number = 0.0;
    const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, number);

    if (error != std::errc{} || stop != text.data() + end || !std::isfinite(number)) fail("is not a list of numbers");
    if (std::abs(number) > kFarthestM) fail("is farther than 1e6 m");
    numbers.push_back(number);
    begin = end + 1;
  }

  return numbers;
}

}  // namespace

/// Two numbers or three.
TypedPose parse_pose(const std::string& what, const std::string& text) {
  const std::string example = "4.5,12 or 4.5,12,1.57 (x and y in metres, yaw in radians)";
  const std::vector<double> numbers = split_numbers(what, text, example);

  if (numbers.size() != 2 && numbers.size() != 3) {
    throw config::BadInput(what + ": '" + text + "' has " + std::to_string(numbers.size()) + " numbers; write e.g. " +
                           example);
  }

  const bool has_yaw = numbers.size() == 3;
  return {{numbers[0], numbers[1], has_yaw ? geometry::wrap(numbers[2]) : 0.0}, has_yaw};
}

/// Lengths must make sense for a vehicle.
geometry::Footprint parse_footprint(const std::string& what, const std::string& text) {
  const std::string example =
      "2.4,1.1 or 2.4,1.1,0.4 (length, width and how far the middle lies ahead of the vehicle's frame, in metres)";
  const std::vector<double> numbers = split_numbers(what, text, example);
  const auto fail = [&](const std::string& why) {
    throw config::BadInput(what + ": '" + text + "' " + why + "; write e.g. " + example);
  };

  if (numbers.size() != 2 && numbers.size() != 3) fail("has " + std::to_string(numbers.size()) + " numbers");
  if (numbers[0] <= 0.0 || numbers[1] <= 0.0) fail("has a length or width that is not above 0");

  for (const double number : numbers) {
    if (std::abs(number) > kLargestM) fail("is more than 100 m");
  }

  return geometry::rectangle(numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 0.0);
}

/// For flags that take a fixed number of them.
std::vector<double> parse_numbers(const std::string& what, const std::string& text, std::size_t count,
                                  const std::string& example) {
  std::vector<double> numbers = split_numbers(what, text, example);
  if (numbers.size() != count) {
    throw config::BadInput(what + ": '" + text + "' has " + std::to_string(numbers.size()) + " numbers, not " +
                           std::to_string(count) + "; write e.g. " + example);
  }

  return numbers;
}

}  // namespace aisle::cli
