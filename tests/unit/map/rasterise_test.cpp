#include "services/map/core/rasterise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <utility>

namespace aisle::map {
namespace {

using fleet::MapEdit;
using geometry::Point2;
using grid::Geometry;

std::set<std::pair<int, int>> cells_of(const std::vector<CellRun>& runs) {
  std::set<std::pair<int, int>> cells;
  for (const CellRun& run : runs) {
    for (int x = run.x_begin; x < run.x_end; ++x)
      EXPECT_TRUE(cells.insert({x, run.y}).second) << "twice: " << x << " " << run.y;
  }
  return cells;
}

MapEdit edit(MapEdit::Shape shape, std::vector<Point2> points, double radius_m = 0.0) {
  MapEdit e;
  e.shape = shape;
  e.points_in_map = std::move(points);
  e.radius_m = radius_m;
  return e;
}

TEST(Rasterise, ARectangleOnCellBordersIsItsCells) {
  const Geometry g{10, 10, 0.1, {1.0, 2.0}};
  // 0.1 has no exact binary form: the borders are where rounding could add a row.
  const auto cells = cells_of(rasterise(edit(MapEdit::Shape::kRectangle, {{1.7, 2.9}, {1.3, 2.2}}), g));
  EXPECT_EQ(cells.size(), 4U * 7U);
  EXPECT_EQ(*cells.begin(), (std::pair<int, int>{3, 2}));
  EXPECT_EQ(*cells.rbegin(), (std::pair<int, int>{6, 8}));
}

TEST(Rasterise, CoversWhatItOverlapsAndClipsToTheMap) {
  const Geometry g{10, 10, 1.0, {0.0, 0.0}};
  EXPECT_EQ(cells_of(rasterise(edit(MapEdit::Shape::kRectangle, {{2.4, 2.4}, {2.6, 3.1}}), g)),
            (std::set<std::pair<int, int>>{{2, 2}, {2, 3}}));
  EXPECT_EQ(cells_of(rasterise(edit(MapEdit::Shape::kRectangle, {{-1e9, -1e9}, {1e9, 1e9}}), g)).size(), 100U);
  EXPECT_TRUE(rasterise(edit(MapEdit::Shape::kRectangle, {{20.0, 2.0}, {30.0, 3.0}}), g).empty());
  EXPECT_TRUE(rasterise(edit(MapEdit::Shape::kRectangle, {{2.0, 2.0}, {2.0, 3.0}}), g).empty()) << "no area";
  EXPECT_EQ(cells_of(rasterise(edit(MapEdit::Shape::kDisc, {{5.0, 5.0}}, 1.0), g)).size(), 4U);
  EXPECT_EQ(cells_of(rasterise(edit(MapEdit::Shape::kDisc, {{5.5, 5.5}}, 0.1), g)),
            (std::set<std::pair<int, int>>{{5, 5}}));
  EXPECT_EQ(cells_of(rasterise(edit(MapEdit::Shape::kDisc, {{5.5, 5.5}}, 0.6), g)).size(), 5U);
}

/// Even-odd rule.
bool is_inside(const std::vector<Point2>& corners, Point2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2 a = corners[i];
    const Point2 b = corners[(i + 1) % corners.size()];
    if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

TEST(Rasterise, CoversEveryPointInsideAndNoCellFarFromTheShape) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const Geometry g{24, 18, 0.25, {-3.0, 1.0}};
    std::uniform_real_distribution<double> x(-4.0, 4.0);
    std::uniform_real_distribution<double> y(0.0, 6.5);
    MapEdit e = edit(seed % 2 == 0 ? MapEdit::Shape::kPolygon : MapEdit::Shape::kDisc, {});
    const int corners = seed % 2 == 0 ? static_cast<int>(3 + random() % 6) : 1;
    for (int i = 0; i < corners; ++i) e.points_in_map.push_back({x(random), y(random)});
    e.radius_m = std::uniform_real_distribution<double>(0.05, 2.0)(random);
    const auto covers = [&](Point2 p) {
      return e.shape == MapEdit::Shape::kDisc ? geometry::distance(p, e.points_in_map[0]) < e.radius_m
                                              : is_inside(e.points_in_map, p);
    };
    const auto cells = cells_of(rasterise(e, g));
    for (int i = 0; i < 3000; ++i) {
      const Point2 p{x(random), y(random)};
      const grid::Cell c = g.cell_at(p);
      ASSERT_TRUE(!g.contains(c) || !covers(p) || cells.count({c.x, c.y}) > 0)
          << "seed " << seed << " at " << p.x << " " << p.y;
    }
    for (const auto& [cx, cy] : cells) {  // a cell is covered somewhere, or an edge runs through it
      const Point2 center = g.center_in_map({cx, cy});
      bool near = e.shape == MapEdit::Shape::kDisc
                      ? geometry::distance(center, e.points_in_map[0]) < e.radius_m + 0.7072 * g.resolution_m
                      : is_inside(e.points_in_map, center);
      for (std::size_t i = 0; !near && i < e.points_in_map.size(); ++i) {
        near =
            geometry::distance_to_segment(center, e.points_in_map[i],
                                          e.points_in_map[(i + 1) % e.points_in_map.size()]) < 0.7072 * g.resolution_m;
      }
      ASSERT_TRUE(near) << "seed " << seed << " cell " << cx << " " << cy;
    }
  }
}

TEST(Rasterise, APolygonThatIsARectangleIsThatRectangle) {
  const Geometry g{30, 30, 0.05, {0.0, 0.0}};
  const auto rectangle = rasterise(edit(MapEdit::Shape::kRectangle, {{0.2, 0.3}, {0.9, 0.75}}), g);
  const auto polygon = rasterise(edit(MapEdit::Shape::kPolygon, {{0.2, 0.3}, {0.9, 0.3}, {0.9, 0.75}, {0.2, 0.75}}), g);
  EXPECT_EQ(cells_of(polygon), cells_of(rectangle));
}

}  // namespace
}  // namespace aisle::map
