#include "common/grid/formats/map_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "common/config/yaml_reader.hpp"
#include "common/grid/formats/map_image.hpp"

namespace aisle::grid {
namespace {

namespace fs = std::filesystem;

/// The file's cells, each cut into subdivide x subdivide; `row_from_top` of the file is given to `cell(x,
/// row_from_top)`.
template <class CellAt>
OccupancyGrid make_grid(int width, int height, double cell_m, int subdivide, geometry::Point2 origin_in_map,
                        CellAt cell_at) {
  OccupancyGrid grid(Geometry{width * subdivide, height * subdivide, cell_m / subdivide, origin_in_map});
  for (int y = 0; y < height * subdivide; ++y) {
    for (int x = 0; x < width * subdivide; ++x) grid.set({x, y}, cell_at(x / subdivide, height - 1 - y / subdivide));
  }

  return grid;
}

/// Lines without their ends (LF or CRLF) and without a byte order mark; empty lines at the end are dropped.
std::vector<std::string_view> lines_of(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());

  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);

    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }

  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

/// For errors: the character itself, or its number when it is not visible.
std::string printable(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code >= 0x21 && code < 0x7f ? "'" + std::string(1, c) + "'" : "byte " + std::to_string(code);
}

/// Rows of characters, the first on top; `known` turns a character into a cell or throws.
template <class Known>
OccupancyGrid read_rows(const fs::path& file, const std::vector<std::string_view>& lines, std::size_t first_line,
                        const MapFileOptions& options, Known known) {
  const std::size_t width = lines[first_line].size();
  const std::size_t height = lines.size() - first_line;

  require_map_size(file, static_cast<long long>(width), static_cast<long long>(height), options.subdivide);

  for (std::size_t row = 0; row < height; ++row) {
    const std::string line_name = "line " + std::to_string(first_line + row + 1);
    const std::string_view line = lines[first_line + row];

    if (line.size() != width) {
      reject(file, line_name + " has " + std::to_string(line.size()) + " cells, it should have " +
                       std::to_string(width) + ": the file is cut off or damaged");
    }

    for (std::size_t x = 0; x < width; ++x) {
      if (!known(line[x]))
        reject(file, line_name + ", column " + std::to_string(x + 1) + ": " + printable(line[x]) + " is no known cell");
    }
  }

  return make_grid(static_cast<int>(width), static_cast<int>(height), options.moving_ai_cell_m, options.subdivide,
                   {0.0, 0.0}, [&](int x, int row) {
                     return *known(lines[first_line + static_cast<std::size_t>(row)][static_cast<std::size_t>(x)]);
                   });
}

/// None: no known character; the same for moving_ai_cell().
std::optional<Occupancy> text_cell(char c) {
  if (c == '.') return Occupancy::kFree;
  if (c == '#') return Occupancy::kOccupied;
  if (c == '?') return Occupancy::kUnknown;
  return std::nullopt;
}

std::optional<Occupancy> moving_ai_cell(char c) {
  if (c == '.' || c == 'G' || c == 'S') return Occupancy::kFree;
  if (c == '@' || c == 'O' || c == 'T' || c == 'W') return Occupancy::kOccupied;
  return std::nullopt;
}

/// Rows only, without a header.
OccupancyGrid read_text_grid(const fs::path& file, const MapFileOptions& options) {
  const std::string text = read_bytes(file);
  const std::vector<std::string_view> lines = lines_of(text);
  if (lines.empty()) reject(file, "has no cells: '#' is occupied, '.' free, '?' unknown");
  return read_rows(file, lines, 0, options, text_cell);
}

/// The number behind `key` in this line of the header.
long long header_number(const fs::path& file, const std::vector<std::string_view>& lines, std::size_t line,
                        const std::string& key) {
  const std::string where = "line " + std::to_string(line + 1);
  const std::string_view text = lines[line];

  if (text.substr(0, key.size() + 1) != key + " ") reject(file, where + " should be '" + key + " NUMBER'");

  const std::string digits(text.substr(key.size() + 1));
  if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos) {
    reject(file, where + ": " + key + " '" + digits.substr(0, 20) + "' is not a number from 1 to 999999999");
  }

  return std::stoll(digits);
}

/// The benchmark's format (Sturtevant 2012): four lines of header (type, height, width, map), then the
/// rows.
OccupancyGrid read_moving_ai(const fs::path& file, const MapFileOptions& options) {
  constexpr std::size_t kHeaderLines = 4;
  const std::string text = read_bytes(file);
  const std::vector<std::string_view> lines = lines_of(text);

  if (lines.empty() || lines[0].substr(0, 5) != "type ")
    reject(file, "line 1 should be 'type octile': it is not a Moving AI map");

  if (lines.size() < kHeaderLines)
    reject(file, "ends within its header (type, height, width, map): the file is cut off");

  const long long height = header_number(file, lines, 1, "height");
  const long long width = header_number(file, lines, 2, "width");

  if (lines[3] != "map") reject(file, "line 4 should be 'map'");
  require_map_size(file, width, height, options.subdivide);

  const std::size_t rows = lines.size() - kHeaderLines;
  if (static_cast<long long>(rows) != height) {
    reject(file, "has " + std::to_string(rows) + " rows, its header says height " + std::to_string(height) +
                     ": the file is cut off or damaged");
  }

  if (static_cast<long long>(lines[kHeaderLines].size()) != width) {
    reject(file, "line 5 has " + std::to_string(lines[kHeaderLines].size()) + " cells, the header says width " +
                     std::to_string(width));
  }

  return read_rows(file, lines, kHeaderLines, options, moving_ai_cell);
}

enum class Mode { kTrinary, kScale, kRaw };

/// A ROS map_server file, as ROS itself names the keys.
struct RosMap {
  std::string image;
  std::string mode_name{"trinary"};
  std::string negate_text{"0"};
  double resolution_m{0.0};
  std::vector<double> origin;
  double occupied_thresh{0.65};
  double free_thresh{0.196};
  Mode mode{Mode::kTrinary};
  bool negate{false};

  template <class Reader>
  void describe(Reader& r) {
    r.field("image", image)
        .field("mode", mode_name)
        .field("resolution", resolution_m, 1e-3, 1e3)
        .field("origin", origin, -1e6, 1e6)
        .field("negate", negate_text)
        .field("occupied_thresh", occupied_thresh, 0.0, 1.0)
        .field("free_thresh", free_thresh, 0.0, 1.0)
        .require({"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"});

    if (!r.has("image") || !r.has("origin")) return;  // finish() will say so

    check(r);
  }

  template <class Reader>
  void check(Reader& r) {
    if (origin.size() != 3)
      r.reject("origin", "has " + std::to_string(origin.size()) + " numbers, not the three x, y, yaw");

    if (origin[2] != 0.0) {
      r.reject("origin",
               "yaw = " + std::to_string(origin[2]) + " rad, only 0 is supported: turn the image instead and write 0");
    }

    if (free_thresh >= occupied_thresh) r.reject("free_thresh", "must be less than occupied_thresh");

    if (mode_name == "trinary")
      mode = Mode::kTrinary;
    else if (mode_name == "scale")
      mode = Mode::kScale;
    else if (mode_name == "raw")
      mode = Mode::kRaw;
    else
      r.reject("mode", "'" + mode_name + "' is not trinary, scale or raw");

    if (negate_text == "0" || negate_text == "false")
      negate = false;
    else if (negate_text == "1" || negate_text == "true")
      negate = true;
    else
      r.reject("negate", "'" + negate_text + "' is not 0 or 1");

    if (image.empty()) r.reject("image", "is empty: name the PGM or PNG beside this file");
  }

  /// Trinary as map_server does it; in scale and raw mode what lies between the thresholds is unknown to us as well.
  Occupancy cell(std::uint8_t shade) const {
    const double black = mode == Mode::kRaw ? shade / 100.0 : (negate ? shade : 255 - shade) / 255.0;
    if (black > 1.0) return Occupancy::kUnknown;
    if (mode == Mode::kRaw ? black >= occupied_thresh : black > occupied_thresh) return Occupancy::kOccupied;
    if (mode == Mode::kRaw ? black <= free_thresh : black < free_thresh) return Occupancy::kFree;
    return Occupancy::kUnknown;
  }
};

/// The image's path; it must lie in the folder of the yaml file, or below.
fs::path image_path(const fs::path& yaml_file, const RosMap& map) {
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(fs::absolute(yaml_file).parent_path(), error);
  const fs::path image = fs::weakly_canonical(folder / map.image, error);
  const fs::path inside = image.lexically_relative(folder);

  if (error || inside.empty() || *inside.begin() == "..") {
    reject(yaml_file, "image '" + map.image + "' lies outside the folder of this file: put it beside the file");
  }

  return image;
}

/// As map_server reads it: the yaml names the image; row 0 of the image is the top of the map.
OccupancyGrid read_ros_map(const fs::path& file, const MapFileOptions& options) {
  read_bytes(file);  // says clearly when it is missing or empty

  RosMap map;
  config::read_yaml_file(file, map);

  const fs::path image_file = image_path(file, map);
  std::error_code error;

  if (!fs::exists(image_file, error)) reject(file, "image '" + map.image + "': no such file as " + image_file.string());

  const MapImage image = parse_picture(image_file, read_bytes(image_file), options.subdivide);

  return make_grid(image.width, image.height, map.resolution_m, options.subdivide, {map.origin[0], map.origin[1]},
                   [&](int x, int row) {
                     const std::size_t i = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                                           static_cast<std::size_t>(x);
                     return !image.alpha.empty() && image.alpha[i] == 0 ? Occupancy::kUnknown
                                                                        : map.cell(image.shade[i]);
                   });
}

}  // namespace

/// Dispatches on the ending.
OccupancyGrid read_map_file(const fs::path& file, const MapFileOptions& options) {
  if (options.subdivide < 1 || options.subdivide > 64) {
    reject(file, "subdivide = " + std::to_string(options.subdivide) + " is not within 1 and 64");
  }

  if (!(options.moving_ai_cell_m >= 1e-3 && options.moving_ai_cell_m <= 1e3)) {
    reject(file, "cell size = " + std::to_string(options.moving_ai_cell_m) + " m is not within 0.001 and 1000");
  }

  const std::string ending = file.extension().string();
  if (ending == ".yaml" || ending == ".yml") return read_ros_map(file, options);
  if (ending == ".map") return read_moving_ai(file, options);
  if (ending == ".txt") return read_text_grid(file, options);

  reject(file, "ending '" + ending + "' is no known map: .yaml (ROS), .map (Moving AI) or .txt (text grid)");
}

}  // namespace aisle::grid
