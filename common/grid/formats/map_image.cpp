#include "common/grid/formats/map_image.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "common/config/reader.hpp"

namespace aisle::grid {
namespace {

constexpr std::uintmax_t kMaxFileBytes = 512ULL << 20U;
constexpr long long kMaxTiles = 16384;
constexpr long long kTileSize = 64;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

/// The numbers of a PGM, with comments between them.
class PgmReader {
 public:
  PgmReader(const std::filesystem::path& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  /// The next number; `field` names it in errors.
  long long number(const char* field, long long low, long long high) {
    skip_space();
    if (at_ == bytes_.size()) reject(file_, std::string("ends where ") + field + " should be: the file is cut off");
    long long value = 0;

    const std::size_t begin = at_;
    while (at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9') {
      value = std::min(value * 10 + (bytes_[at_++] - '0'), 1000000000000LL);
    }

    if (at_ == begin) reject(file_, std::string(field) + " at byte " + std::to_string(at_) + " is not a number");

    if (value < low || value > high) {
      reject(file_, std::string(field) + " = " + std::to_string(value) + " is not within " + std::to_string(low) +
                        " and " + std::to_string(high));
    }

    return value;
  }

  /// The one white space between header and pixels.
  std::string_view raster() {
    if (at_ == bytes_.size()) reject(file_, "ends after its header: the file is cut off");

    if (bytes_[at_] == '\r')
      reject(file_,
             "has CRLF after its header: a binary PGM was converted as if it were text; copy it again as binary");

    if (!is_space(bytes_[at_])) reject(file_, "lacks a white space after its header");
    return bytes_.substr(at_ + 1);
  }

 private:
  /// Space, and comments from # to the end of the line.
  void skip_space() {
    while (at_ < bytes_.size() && (is_space(bytes_[at_]) || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#') {
        at_ = std::min(bytes_.find('\n', at_), bytes_.size());
      } else {
        ++at_;
      }
    }
  }

  const std::filesystem::path& file_;
  std::string_view bytes_;
  std::size_t at_{2};
};

/// Rounded to the nearest.
std::uint8_t to_8_bits(long long value, long long max_value) {
  return static_cast<std::uint8_t>((value * 255 + max_value / 2) / max_value);
}

/// One byte a pixel, or two with the high one first when the maximum is above 255.
void read_binary_raster(const std::filesystem::path& file, std::string_view raster, long long max_value,
                        MapImage& image) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const std::size_t width = max_value > 255 ? 2 : 1;

  if (raster.size() < pixels * width) {
    reject(file, "has " + std::to_string(raster.size()) + " bytes of pixels, its header says " +
                     std::to_string(image.width) + " x " + std::to_string(image.height) + " = " +
                     std::to_string(pixels * width) + ": the file is cut off");
  }

  image.shade.resize(pixels);

  for (std::size_t i = 0; i < pixels; ++i) {
    long long value = static_cast<unsigned char>(raster[i * width]);
    if (width == 2) value = value * 256 + static_cast<unsigned char>(raster[i * 2 + 1]);
    image.shade[i] = to_8_bits(std::min(value, max_value), max_value);
  }
}

}  // namespace

void reject(const std::filesystem::path& file, const std::string& what) {
  throw config::BadInput(file.string() + ": " + what);
}

/// Looks at kind and size before it reads.
std::string read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);

  if (!std::filesystem::exists(status)) reject(file, "no such file");
  if (!std::filesystem::is_regular_file(status)) reject(file, "is not a file");

  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) reject(file, "cannot be read: " + error.message());
  if (size == 0) reject(file, "is empty");

  if (size > kMaxFileBytes)
    reject(file, "has " + std::to_string(size) + " bytes, at most " + std::to_string(kMaxFileBytes) + " are read");

  std::string bytes(size, '\0');
  std::ifstream in(file, std::ios::binary);

  if (!in) reject(file, "cannot be opened: check its permissions");
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(in.gcount()) != size) reject(file, "cannot be read to its end");

  return bytes;
}

/// Counted in tiles, as a map is kept and sent.
void require_map_size(const std::filesystem::path& file, long long width, long long height, int subdivide) {
  const auto tiles_along = [&](long long cells) { return (cells * subdivide + kTileSize - 1) / kTileSize; };
  constexpr long long kMaxEdge = kMaxTiles * kTileSize;

  if (width < 1 || height < 1)
    reject(file, "is " + std::to_string(width) + " x " + std::to_string(height) + " cells: a map has at least one");

  if (width > kMaxEdge || height > kMaxEdge || tiles_along(width) * tiles_along(height) > kMaxTiles) {
    reject(file, "is " + std::to_string(width) + " x " + std::to_string(height) + " cells" +
                     (subdivide > 1 ? ", each cut into " + std::to_string(subdivide) + " x " + std::to_string(subdivide)
                                    : std::string()) +
                     "; a map has at most " + std::to_string(kMaxTiles) +
                     " tiles of 64 x 64: use a coarser resolution or crop it");
  }
}

/// The header's numbers are checked before anything is allocated for them.
MapImage parse_pgm(const std::filesystem::path& file, std::string_view bytes, int subdivide) {
  if (bytes.size() < 2 || bytes[0] != 'P' || (bytes[1] != '2' && bytes[1] != '5')) {
    reject(file, "does not begin with P5 or P2: it is not a PGM image; convert it to PGM or PNG");
  }

  PgmReader reader(file, bytes);
  const long long width = reader.number("width", 1, 1000000000LL);
  const long long height = reader.number("height", 1, 1000000000LL);
  const long long max_value = reader.number("maximum grey value", 1, 65535);

  require_map_size(file, width, height, subdivide);

  MapImage image{static_cast<int>(width), static_cast<int>(height), {}, {}};
  if (bytes[1] == '5') {
    read_binary_raster(file, reader.raster(), max_value, image);
    return image;
  }

  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (bytes.size() < pixels) {
    reject(file, "has " + std::to_string(bytes.size()) + " bytes, too few for " + std::to_string(width) + " x " +
                     std::to_string(height) + " pixels: the file is cut off");
  }

  image.shade.reserve(pixels);

  for (std::size_t i = 0; i < pixels; ++i)
    image.shade.push_back(to_8_bits(reader.number("a pixel", 0, max_value), max_value));

  return image;
}

/// libpng checks the rest; what is checked here keeps it from allocating for pixels that the file
/// cannot hold: deflate packs at most 1032 to one.
MapImage parse_png(const std::filesystem::path& file, std::string_view bytes, int subdivide) {
  constexpr std::size_t kDeflateAtBest = 1040;  // to one
  constexpr std::string_view kMagic = "\x89PNG\r\n\x1a\n";

  if (bytes.substr(0, kMagic.size()) != kMagic) reject(file, "does not begin as a PNG does; convert it to PGM or PNG");

  if (bytes.rfind("IEND\xAE\x42\x60\x82") == std::string_view::npos)
    reject(file, "lacks the end of a PNG: the file is cut off");

  // The header: size and kind of the pixels.
  png_image png{};
  png.version = PNG_IMAGE_VERSION;

  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    const std::string why = png.message;
    png_image_free(&png);
    reject(file, "is not a whole PNG: " + why);
  }

  const long long width = png.width;
  const long long height = png.height;

  try {
    require_map_size(file, width, height, subdivide);

    if (static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) / 8 > bytes.size() * kDeflateAtBest) {
      reject(file, "claims " + std::to_string(width) + " x " + std::to_string(height) + " pixels, more than its " +
                       std::to_string(bytes.size()) + " bytes can hold");
    }
  } catch (...) {
    png_image_free(&png);
    throw;
  }

  // The pixels, as grey with or without alpha.
  const bool has_alpha = (png.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  png.format = has_alpha ? PNG_FORMAT_GA : PNG_FORMAT_GRAY;

  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr) == 0) {
    const std::string why = png.message;
    png_image_free(&png);
    reject(file, "is not a whole PNG: " + why);
  }

  MapImage image{static_cast<int>(width), static_cast<int>(height), {}, {}};
  if (!has_alpha) {
    image.shade = std::move(pixels);
    return image;
  }

  for (std::size_t i = 0; i + 1 < pixels.size(); i += 2) {
    image.shade.push_back(pixels[i]);
    image.alpha.push_back(pixels[i + 1]);
  }

  return image;
}

MapImage parse_picture(const std::filesystem::path& file, std::string_view bytes, int subdivide) {
  const bool is_png = !bytes.empty() && bytes[0] == '\x89';
  return is_png ? parse_png(file, bytes, subdivide) : parse_pgm(file, bytes, subdivide);
}

}  // namespace aisle::grid
