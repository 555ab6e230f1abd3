#include "common/process/kept_file.hpp"

#include <cstdint>

#include "common/process/file_store.hpp"

namespace aisle::process {

bool keep_in_file(const std::filesystem::path& file, const std::string& text) { return file_store().write(file, text); }

std::optional<std::string> read_kept_file(const std::filesystem::path& file) {
  constexpr std::uintmax_t kLargestBytes = 65536;
  return file_store().read(file, kLargestBytes);
}

}  // namespace aisle::process
