#include "common/grid/clearance_lanes.hpp"

namespace aisle::grid {
namespace {

constexpr float kNoCells[2]{};

}  // namespace

ClearanceLanes::ClearanceLanes(const ClearanceField& field)
    : field_(field),
      cells_m_(field.cells_m().data()),
      width_(field.geometry().width),
      origin_x_(field.geometry().origin_in_map.x),
      origin_y_(field.geometry().origin_in_map.y),
      cell_m_(field.geometry().resolution_m),
      last_u_(width_ - 1.0),
      last_v_(field.geometry().height - 1.0),
      cells_a_metre_(1.0 / cell_m_),
      columns_(width_),
      rows_(field.geometry().height) {
  if (width_ < 2 || field.geometry().height < 2)
    cells_m_ = kNoCells, width_ = 0, columns_ = 0.0;  // no point lies between four cells
}

void ClearanceLanes::find_others_m(const geometry::Wide& x, const geometry::Wide& y, const geometry::WideMarks& wanted,
                                   geometry::Wide& clearance_m) const {
  for (std::size_t i = 0; i < geometry::kWide; ++i)
    if (wanted[i] != 0 && !(clearance_m[i] > 0.0)) clearance_m[i] = field_.clearance_m(geometry::Point2{x[i], y[i]});
}

}  // namespace aisle::grid
