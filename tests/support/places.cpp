#include "tests/support/places.hpp"

namespace aisle::test_support {

std::filesystem::path source_folder() { return AISLE_SOURCE_DIR; }

std::filesystem::path program_folder() { return std::filesystem::path(AISLE_BUILD_DIR) / "bin"; }

std::string program(const std::string& name) { return (program_folder() / name).string(); }

std::string test_program(const std::string& name) {
  return (std::filesystem::path(AISLE_BUILD_DIR) / "tests" / name).string();
}

}  // namespace aisle::test_support
