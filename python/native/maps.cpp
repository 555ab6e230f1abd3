#include <pybind11/stl.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "common/config/reader.hpp"
#include "common/grid/formats/map_image.hpp"
#include "python/native/arguments.hpp"
#include "python/native/bindings.hpp"
#include "python/native/map.hpp"
#include "tools/lab/planning/drawn_map.hpp"

namespace aisle::python {

namespace py = pybind11;
using Cells = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;
using Point = std::pair<double, double>;

std::shared_ptr<const grid::ClearanceField> Map::clearance(double cap_m) const {
  const std::lock_guard lock(mutex_);
  if (clearance_ == nullptr || cap_m != cap_m_) {
    clearance_ = std::make_shared<grid::ClearanceField>(grid_, cap_m);
    cap_m_ = cap_m;
  }

  return clearance_;
}

namespace {

// The edge of a cell, as in the files of ROS maps.
constexpr double kLeastResolutionM = 0.001, kLargestResolutionM = 1000.0;

/// @throws config::BadInput that names `what`
std::optional<geometry::Point2> point_of(const std::string& what, const std::optional<Point>& place) {
  if (!place) return std::nullopt;
  if (!std::isfinite(place->first) || !std::isfinite(place->second))
    throw config::BadInput("map: " + what + " is not finite");

  return geometry::Point2{place->first, place->second};
}

/// `cells`: (height, width), row 0 lowest, 0 free, 1 occupied, 2 unknown.
std::shared_ptr<Map> map_of(const Cells& cells, double resolution_m, Point origin_m, const std::optional<Point>& start,
                            const std::optional<Point>& goal) {
  if (cells.ndim() != 2) throw config::BadInput("map: cells have two dimensions, rows and columns");
  within("map: resolution_m", resolution_m, kLeastResolutionM, kLargestResolutionM);
  for (const double coordinate_m : {origin_m.first, origin_m.second})
    if (!std::isfinite(coordinate_m)) throw config::BadInput("map: origin_m is not finite");

  const grid::Geometry geometry{static_cast<int>(cells.shape(1)),
                                static_cast<int>(cells.shape(0)),
                                resolution_m,
                                {origin_m.first, origin_m.second}};
  grid::require_map_size("map", geometry.width, geometry.height, 1);
  grid::OccupancyGrid grid(geometry);

  const auto values = cells.unchecked<2>();
  for (int y = 0; y < geometry.height; ++y)
    for (int x = 0; x < geometry.width; ++x) {
      if (values(y, x) > 2) throw config::BadInput("map: cells are 0 (free), 1 (occupied) or 2 (unknown)");
      grid.set({x, y}, static_cast<grid::Occupancy>(values(y, x)));
    }

  return std::make_shared<Map>(std::move(grid), point_of("start_m", start), point_of("goal_m", goal));
}

/// A file of any kind; without a resolution where the file says it or cells of 1 m are meant.
std::shared_ptr<Map> read_map(const std::string& path, std::optional<double> resolution_m) {
  if (resolution_m) within("resolution_m", *resolution_m, kLeastResolutionM, kLargestResolutionM);

  const py::gil_scoped_release unlocked;
  lab::LabMap map = lab::read_lab_map(path, resolution_m.value_or(0.0));
  return std::make_shared<Map>(std::move(map.grid), map.start_in_map, map.goal_in_map);
}

/// A copy of the cells: (height, width), row 0 lowest.
py::array_t<std::uint8_t> cells_of(const Map& map) {
  const grid::Geometry& geometry = map.grid().geometry();
  py::array_t<std::uint8_t> cells({geometry.height, geometry.width});
  std::memcpy(cells.mutable_data(), map.grid().cells().data(), geometry.cells());
  return cells;
}

std::optional<Point> pair_of(const std::optional<geometry::Point2>& in_map) {
  if (!in_map) return std::nullopt;
  return Point{in_map->x, in_map->y};
}

}  // namespace

void bind_maps(py::module_& module) {
  py::class_<Map, std::shared_ptr<Map>>(module, "Map")
      .def(py::init(&map_of), py::arg("cells"), py::arg("resolution_m"), py::arg("origin_m"), py::arg("start_m"),
           py::arg("goal_m"))
      .def_property_readonly("cells", &cells_of)
      .def_property_readonly("resolution_m", [](const Map& map) { return map.grid().geometry().resolution_m; })
      .def_property_readonly("origin_m",
                             [](const Map& map) {
                               const geometry::Point2 origin = map.grid().geometry().origin_in_map;
                               return Point{origin.x, origin.y};
                             })
      .def_property_readonly("start_m", [](const Map& map) { return pair_of(map.start_in_map()); })
      .def_property_readonly("goal_m", [](const Map& map) { return pair_of(map.goal_in_map()); });
  module.def("read_map", &read_map, py::arg("path"), py::arg("resolution_m"));
}

}  // namespace aisle::python
