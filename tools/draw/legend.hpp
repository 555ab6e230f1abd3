#pragma once

#include <string>
#include <string_view>

#include "tools/draw/svg.hpp"

namespace aisle::draw {

/// Entries beside each other, each a symbol drawn around (0, 0) and its name. The caller says how wide an entry is:
/// an SVG's text has no width before it is shown.
class Legend {
 public:
  /// The first entry stands at (x, y); names stand `name_at_px` to the right of their symbols.
  Legend(Px x, Px y, int name_at_px, std::string name_attributes);

  /// `width`: from the beginning of this entry to that of the next.
  void add(std::string_view symbol, std::string_view name, Px width);

  /// All entries so far.
  const std::string& svg() const { return svg_; }

 private:
  Px x_;
  Px y_;
  int name_at_px_;
  std::string name_attributes_;
  std::string svg_;
};

/// A stroke in a curve's colour and the curve's name beside it.
std::string curve_key(int x_px, int y_px, std::string_view colour, std::string_view name);

}  // namespace aisle::draw
