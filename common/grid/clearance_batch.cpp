#include "common/grid/clearance_batch.hpp"

namespace aisle::grid {
namespace {

constexpr float kNoCells[2]{};

}  // namespace

/// Everything that a lookup needs lies in members, so that it stays in registers.
ClearanceBatch::ClearanceBatch(const ClearanceField& field)
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

double ClearanceBatch::rough_m(geometry::Point2 in_map) const {
  const double u = (in_map.x - origin_x_) * cells_a_metre_, v = (in_map.y - origin_y_) * cells_a_metre_;
  if (!(u >= 0.0 && v >= 0.0 && u < columns_ && v < rows_)) return 0.0;
  return static_cast<double>(cells_m_[static_cast<int>(v) * width_ + static_cast<int>(u)]) - cell_m_;
}

void ClearanceBatch::look_up_others(const geometry::Batch& x, const geometry::Batch& y,
                                    const geometry::BatchMask& wanted, geometry::Batch& clearance_m) const {
  for (std::size_t i = 0; i < geometry::kBatch; ++i)
    if (wanted[i] != 0 && !(clearance_m[i] > 0.0)) clearance_m[i] = field_.clearance_m(geometry::Point2{x[i], y[i]});
}

}  // namespace aisle::grid
