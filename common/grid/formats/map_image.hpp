#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace aisle::grid {

/// A grey picture; row 0 on top.
struct MapImage {
  int width{0};
  int height{0};
  std::vector<std::uint8_t> shade;  // 0 black, 255 white
  std::vector<std::uint8_t> alpha;  // empty: opaque; else 0 transparent
};

/// The file's bytes, at most 512 MiB. @throws config::BadInput when it is missing, not a file, empty or too large
std::string read_bytes(const std::filesystem::path& file);

/// Throws BadInput "file: what".
[[noreturn]] void reject(const std::filesystem::path& file, const std::string& what);

/// Throws BadInput unless width x height cells, each cut into subdivide x subdivide, fit into a map.
void require_map_size(const std::filesystem::path& file, long long width, long long height, int subdivide);

/// PGM, P2 (text) or P5 (binary), of 8 or 16 bits, scaled to 8 (Netpbm's format). `file` is only named
/// in errors. @throws config::BadInput also when the map would be too large
MapImage parse_pgm(const std::filesystem::path& file, std::string_view bytes, int subdivide);

/// PNG of any kind, turned into 8 bits of grey; otherwise as parse_pgm.
MapImage parse_png(const std::filesystem::path& file, std::string_view bytes, int subdivide);

/// Either of them, told apart by the first byte. @throws config::BadInput
MapImage parse_picture(const std::filesystem::path& file, std::string_view bytes, int subdivide);

}  // namespace aisle::grid
