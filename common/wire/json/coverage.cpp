#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "common/wire/json/json.hpp"

namespace aisle::wire {
namespace {

constexpr int kSeenLongAgo = 254;
constexpr int kNeverSeen = 255;

/// One letter a cell: '#' seen in the last second, '+' in the last ten, '.' longer ago, ' ' never.
char letter(std::uint8_t age, double age_step_s) {
  if (age == kNeverSeen) return ' ';
  const double age_s = age * age_step_s;
  return age >= kSeenLongAgo || age_s > 10.0 ? '.' : age_s > 1.0 ? '+' : '#';
}

/// The tile as it lies in the map: the uppermost row first.
Json picture_of(const aisle::Coverage& sample) {
  Json rows = Json::array();
  const std::size_t width = sample.width_cells();
  const std::size_t height =
      width == 0 ? 0 : std::min<std::size_t>(sample.height_cells(), sample.ages().size() / width);

  for (std::size_t y = height; y-- > 0;) {
    std::string row;
    for (std::size_t x = 0; x < width; ++x) row += letter(sample.ages()[y * width + x], sample.age_step_s());
    rows.push_back(std::move(row));
  }

  return rows;
}

}  // namespace

/// The picture has a letter for each cell, the top row first.
Json to_json(const aisle::Coverage& sample) {
  const auto count = [&](auto is_counted) {
    return std::count_if(sample.ages().begin(), sample.ages().end(), is_counted);
  };

  return Json{{"source_id", sample.source_id().to_string()},
              {"tile_x", sample.tile_x()},
              {"tile_y", sample.tile_y()},
              {"by", to_json(sample.by())},
              {"map_id", sample.map_id().to_string()},
              {"low_in_map", to_json(sample.low_in_map())},
              {"cell_m", sample.cell_m()},
              {"width_cells", sample.width_cells()},
              {"height_cells", sample.height_cells()},
              {"age_step_s", sample.age_step_s()},
              {"cells_seen_in_1_s", count([&](std::uint8_t age) { return letter(age, sample.age_step_s()) == '#'; })},
              {"cells_never_seen", count([](std::uint8_t age) { return age == kNeverSeen; })},
              {"ages", sample.ages()},
              {"picture", picture_of(sample)}};
}

}  // namespace aisle::wire
