#include "tools/cli/edit_shape.hpp"

#include <cstddef>

#include "common/config/reader.hpp"
#include "tools/cli/coordinates.hpp"

namespace aisle::cli {
namespace {

constexpr std::size_t kMostCorners = 64;

void add_point(fleet::MapEdit& edit, double x_m, double y_m) { edit.points_in_map.push_back({x_m, y_m}); }

/// Two opposite corners.
void set_rectangle(const std::string& typed, fleet::MapEdit& edit) {
  const std::vector<double> numbers =
      parse_numbers("--rect", typed, 4, "--rect 1,2,4.5,3 (two opposite corners in metres)");
  if (numbers[0] == numbers[2] || numbers[1] == numbers[3])
    throw config::BadInput("--rect: '" + typed + "' has no area");

  edit.shape = fleet::MapEdit::Shape::kRectangle;
  add_point(edit, numbers[0], numbers[1]);
  add_point(edit, numbers[2], numbers[3]);
}

/// Centre and radius.
void set_disc(const std::string& typed, fleet::MapEdit& edit) {
  const std::vector<double> numbers =
      parse_numbers("--disc", typed, 3, "--disc 4,2.5,0.6 (centre and radius in metres)");
  if (numbers[2] <= 0.0) throw config::BadInput("--disc: the radius of '" + typed + "' must be above 0");

  edit.shape = fleet::MapEdit::Shape::kDisc;
  add_point(edit, numbers[0], numbers[1]);
  edit.radius_m = numbers[2];
}

/// 3 to 64 corners.
void set_polygon(const std::vector<std::string>& typed, fleet::MapEdit& edit) {
  if (typed.size() < 3 || typed.size() > kMostCorners) {
    throw config::BadInput("--polygon: " + std::to_string(typed.size()) + " corners; give 3 to " +
                           std::to_string(kMostCorners) + ", e.g. --polygon 0,0 4,0 2,3");
  }

  edit.shape = fleet::MapEdit::Shape::kPolygon;

  for (const std::string& corner : typed) {
    const std::vector<double> numbers =
        parse_numbers("--polygon", corner, 2, "--polygon 0,0 4,0 2,3 (corners in metres)");
    add_point(edit, numbers[0], numbers[1]);
  }
}

}  // namespace

/// Exactly one of the three must be given.
void set_shape(const TypedShape& typed, fleet::MapEdit& edit) {
  const int given = (typed.rectangle.empty() ? 0 : 1) + (typed.disc.empty() ? 0 : 1) + (typed.polygon.empty() ? 0 : 1);
  if (given != 1)
    throw config::BadInput("give one shape: --rect x1,y1,x2,y2 or --disc x,y,radius or --polygon x,y x,y x,y ...");
  if (!typed.rectangle.empty()) return set_rectangle(typed.rectangle, edit);
  if (!typed.disc.empty()) return set_disc(typed.disc, edit);

  set_polygon(typed.polygon, edit);
}

}  // namespace aisle::cli
