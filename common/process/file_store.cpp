#include "common/process/file_store.hpp"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <system_error>

namespace aisle::process {
namespace {

/// Files of this host.
class Disk final : public FileStore {
 public:
  /// Written under a temporary name, then renamed.
  bool write(const std::filesystem::path& file, const std::string& text) override {
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

  std::optional<std::string> read(const std::filesystem::path& file, std::uintmax_t most_bytes) const override {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error || size > most_bytes) return std::nullopt;

    std::ifstream in(file, std::ios::binary);
    if (!in) return std::nullopt;

    return std::string((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  }
};

thread_local FileStore* replacement = nullptr;

}  // namespace

FileStore& file_store() {
  static Disk disk;
  return replacement != nullptr ? *replacement : disk;
}

ScopedFileStore::ScopedFileStore(FileStore& store) : before_(replacement) { replacement = &store; }
ScopedFileStore::~ScopedFileStore() { replacement = before_; }

}  // namespace aisle::process
