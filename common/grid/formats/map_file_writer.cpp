#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <string>
#include <system_error>

#include "common/grid/formats/map_file.hpp"
#include "common/grid/tiles.hpp"

namespace aisle::grid {
namespace {

namespace fs = std::filesystem;

/// Throws what errno says.
[[noreturn]] void fail(const fs::path& file, const char* what) {
  throw std::system_error(errno, std::generic_category(), file.string() + ": " + what);
}

/// An open file, closed at the end of its scope.
class FileDescriptor {
 public:
  FileDescriptor(const fs::path& file, int flags) : fd_(::open(file.c_str(), flags | O_CLOEXEC, 0644)) {
    if (fd_ < 0) fail(file, "cannot be opened");
  }

  ~FileDescriptor() { ::close(fd_); }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

/// Writes the file under a temporary name, synchronises and renames it: on disk is the whole content
/// under its name, or the file that was there before.
void write_whole(const fs::path& file, const std::string& content) {
  const fs::path temporary = file.string() + ".tmp" + std::to_string(::getpid());
  try {
    const FileDescriptor out(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    for (std::size_t done = 0; done < content.size();) {
      const ssize_t n = ::write(out.get(), content.data() + done, content.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail(temporary, "cannot be written");
      done += static_cast<std::size_t>(n);
    }

    if (::fsync(out.get()) != 0) fail(temporary, "cannot be synchronised");
    if (::rename(temporary.c_str(), file.c_str()) != 0) fail(file, "cannot be renamed into place");
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

/// A rename is on disk when its folder is.
void synchronise_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const FileDescriptor handle(folder, O_RDONLY | O_DIRECTORY);
  if (::fsync(handle.get()) != 0) fail(folder, "cannot be synchronised");
}

/// The shortest decimal text that reads back as the same number.
std::string shortest(double value) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

/// Binary PGM with the shades that map_server uses: 254 free, 0 occupied, 205 unknown; the top row
/// first.
std::string pgm_of(const OccupancyGrid& grid) {
  const Geometry& g = grid.geometry();
  std::string pgm = "P5\n" + std::to_string(g.width) + " " + std::to_string(g.height) + "\n255\n";

  pgm.reserve(pgm.size() + g.cells());

  constexpr std::array<char, 3> kShades{static_cast<char>(254), static_cast<char>(0), static_cast<char>(205)};
  for (int y = g.height - 1; y >= 0; --y) {
    for (int x = 0; x < g.width; ++x) pgm.push_back(kShades[static_cast<std::size_t>(grid.at({x, y}))]);
  }

  return pgm;
}

/// Another content, another name: a yaml never points at an image of another map.
std::string image_name_of(const fs::path& yaml_file, const OccupancyGrid& grid) {
  std::array<char, 20> hash{};
  std::snprintf(hash.data(), hash.size(), "%016llx", static_cast<unsigned long long>(tile_hash(grid.cells())));
  return yaml_file.stem().string() + "-" + hash.data() + ".pgm";
}

/// The image that the yaml file names now, if it is one of ours; else empty.
std::string image_written_before(const fs::path& yaml_file) {
  std::ifstream in(yaml_file);
  std::string line;
  const std::string begin = "image: " + yaml_file.stem().string() + "-";
  const std::size_t length = begin.size() + 16 + 4;
  if (!std::getline(in, line) || line.size() != length || line.compare(0, begin.size(), begin) != 0) return {};

  const std::string hash = line.substr(begin.size(), 16);
  if (hash.find_first_not_of("0123456789abcdef") != std::string::npos || line.substr(length - 4) != ".pgm") return {};

  return line.substr(7);
}

}  // namespace

/// The order makes it safe: first the new image, then the yaml that names it, then the old image goes.
void write_ros_map(const OccupancyGrid& grid, const fs::path& yaml_file) {
  const std::string before = image_written_before(yaml_file);
  const std::string image = image_name_of(yaml_file, grid);
  const Geometry& g = grid.geometry();

  write_whole(yaml_file.parent_path() / image, pgm_of(grid));
  synchronise_folder(yaml_file);

  write_whole(yaml_file, "image: " + image + "\nmode: trinary\nresolution: " + shortest(g.resolution_m) +
                             "\norigin: [" + shortest(g.origin_in_map.x) + ", " + shortest(g.origin_in_map.y) +
                             ", 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");

  synchronise_folder(yaml_file);
  if (!before.empty() && before != image) ::unlink((yaml_file.parent_path() / before).c_str());
}

}  // namespace aisle::grid
