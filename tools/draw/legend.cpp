#include "tools/draw/legend.hpp"

#include <fmt/format.h>

#include <utility>

namespace aisle::draw {

Legend::Legend(Px x, Px y, int name_at_px, std::string name_attributes)
    : x_(x), y_(y), name_at_px_(name_at_px), name_attributes_(std::move(name_attributes)) {}

void Legend::add(std::string_view symbol, std::string_view name, Px width) {
  svg_ += moved(x_, y_, std::string(symbol) + text(name_at_px_, 4, name_attributes_, name)) + "\n";
  x_ = x_ + width;
}

std::string curve_key(int x_px, int y_px, std::string_view colour, std::string_view name) {
  return path(fmt::format("M{} {}h24", x_px, y_px), fmt::format("stroke=\"{}\" stroke-width=\"3\"", colour)) +
         text(x_px + 30, y_px + 4, "", name) + "\n";
}

}  // namespace aisle::draw
