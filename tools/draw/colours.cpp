#include "tools/draw/colours.hpp"

#include <array>

namespace aisle::draw {

const char* colour(std::size_t index, std::size_t of_first) {
  static constexpr std::array<const char*, 10> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                                        "#56b4e9", "#6a3d9a", "#8c6d31", "#b2182b", "#1b7837"};
  return kColours[index % of_first];
}

}  // namespace aisle::draw
