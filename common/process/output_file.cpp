#include "common/process/output_file.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <system_error>

#include "common/config/reader.hpp"

namespace aisle::process {
namespace {

config::BadEnvironment not_writable(const std::string& file) {
  return config::BadEnvironment(file + ": cannot be written; check the folder and its permissions");
}

/// Is it there as a folder, or as a file, and may we write to it?
bool takes_writing(const std::filesystem::path& place, bool is_folder) {
  std::error_code ignored;
  return std::filesystem::is_directory(place, ignored) == is_folder && access(place.c_str(), W_OK) == 0;
}

}  // namespace

void check_writable(const std::string& file) {
  std::error_code ignored;
  const bool is_there = std::filesystem::exists(file, ignored);
  if (!takes_writing(is_there ? std::filesystem::path(file) : std::filesystem::absolute(file).parent_path(), !is_there))
    throw not_writable(file);
}

void write_output_file(const std::string& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw not_writable(file);
}

}  // namespace aisle::process
