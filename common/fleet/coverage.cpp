#include "common/fleet/coverage.hpp"

#include <algorithm>
#include <utility>

namespace aisle::fleet {
namespace {

constexpr double kJustNowS = 1.0;
constexpr double kRecentlyS = 10.0;

}  // namespace

char letter_of_age(std::uint8_t age, double age_step_s) {
  if (age == kNeverSeen) return ' ';

  const double age_s = age * age_step_s;

  if (age >= kSeenLongAgo || age_s > kRecentlyS) return '.';

  return age_s > kJustNowS ? '+' : '#';
}

std::vector<std::string> picture_of(const std::vector<std::uint8_t>& ages, std::size_t width_cells,
                                    std::size_t height_cells, double age_step_s) {
  std::vector<std::string> rows;
  const std::size_t height = width_cells == 0 ? 0 : std::min(height_cells, ages.size() / width_cells);

  // The last row of the ages is the uppermost of the map.
  for (std::size_t y = height; y-- > 0;) {
    std::string row;

    for (std::size_t x = 0; x < width_cells; ++x) row += letter_of_age(ages[y * width_cells + x], age_step_s);

    rows.push_back(std::move(row));
  }

  return rows;
}

}  // namespace aisle::fleet
