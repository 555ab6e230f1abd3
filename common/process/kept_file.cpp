#include "common/process/kept_file.hpp"

#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <system_error>

namespace aisle::process {

bool keep_in_file(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::path temporary = file;
  temporary += ".new";
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out << text;
    out.flush();
    if (!out) return false;
  }
  std::error_code error;
  std::filesystem::rename(temporary, file, error);
  return !error;
}

std::optional<std::string> read_kept_file(const std::filesystem::path& file) {
  constexpr std::uintmax_t kLargestBytes = 65536;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > kLargestBytes) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
}

}  // namespace aisle::process
