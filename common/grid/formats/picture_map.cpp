#include "common/grid/formats/picture_map.hpp"

#include <string>

#include "common/grid/formats/map_image.hpp"

namespace aisle::grid {
namespace {

constexpr double kOccupiedFrom = 0.65;  // share of black; defaults of ROS map_server
constexpr double kFreeBelow = 0.196;

Occupancy cell_of(std::uint8_t shade) {
  const double black = (255 - shade) / 255.0;
  if (black > kOccupiedFrom) return Occupancy::kOccupied;
  return black < kFreeBelow ? Occupancy::kFree : Occupancy::kUnknown;
}

}  // namespace

bool is_picture(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".png" || ending == ".PNG" || ending == ".pgm" || ending == ".PGM";
}

OccupancyGrid read_picture_map(const std::filesystem::path& file, double cell_m) {
  if (cell_m == 0.0)
    reject(file, "is a picture, which does not say how large a pixel is: give --resolution, e.g. 0.05 (m)");
  if (!(cell_m >= 1e-3 && cell_m <= 1e3))
    reject(file, "resolution = " + std::to_string(cell_m) + " m is not within 0.001 and 1000");

  const MapImage image = parse_picture(file, read_bytes(file), 1);
  OccupancyGrid grid(Geometry{image.width, image.height, cell_m, {}});

  for (int row = 0; row < image.height; ++row) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
      const bool is_transparent = !image.alpha.empty() && image.alpha[i] == 0;
      grid.set({x, image.height - 1 - row}, is_transparent ? Occupancy::kUnknown : cell_of(image.shade[i]));
    }
  }

  return grid;
}

}  // namespace aisle::grid
