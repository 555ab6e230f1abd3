#include "tests/unit/bus/golden_samples.hpp"

#include <cstddef>
#include <cstdio>
#include <fstream>

#include "tests/support/places.hpp"

namespace aisle::bus_test {

std::filesystem::path golden_file(const std::string& topic, const std::string& ending) {
  return test_support::source_folder() / "tests" / "data" / "cdr" / (topic + "." + ending);
}

std::string hex(const Bytes& bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    char two[4];
    std::snprintf(two, sizeof two, "%02x%c", bytes[i], i % 16 == 15 || i + 1 == bytes.size() ? '\n' : ' ');
    text += two;
  }
  return text;
}

Bytes read_golden_bytes(const std::string& topic) {
  std::ifstream file(golden_file(topic));
  Bytes bytes;
  for (std::string two; file >> two;) bytes.push_back(static_cast<std::uint8_t>(std::stoul(two, nullptr, 16)));
  return bytes;
}

}  // namespace aisle::bus_test
