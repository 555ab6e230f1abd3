#include "common/geometry/separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace aisle::geometry {
namespace {

constexpr auto kDisc = Body::Shape::kDisc;
constexpr auto kRectangle = Body::Shape::kRectangle;

std::vector<Point2> edge_of(const Body& body) {
  std::vector<Point2> points;
  for (int i = 0; i < 400; ++i) {
    const double t = i / 400.0;
    if (body.shape == kDisc) {
      points.push_back(
          to_map(body.base_in_map, {body.radius_m * std::cos(2 * kPi * t), body.radius_m * std::sin(2 * kPi * t)}));
      continue;
    }
    const double l = 0.5 * body.length_m, w = 0.5 * body.width_m;
    for (const double side : {-1.0, 1.0}) {
      points.push_back(to_map(body.base_in_map, {(2 * t - 1) * l, side * w}));
      points.push_back(to_map(body.base_in_map, {side * l, (2 * t - 1) * w}));
    }
  }
  return points;
}

Body random_body(std::mt19937& random) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  return {any(random) < 0.4 ? kDisc : kRectangle,
          {4 * any(random), 4 * any(random), 6 * any(random) - 3},
          0.2 + any(random),
          0.3 + 2 * any(random),
          0.3 + any(random)};
}

TEST(Separation, OfBodiesApartIsTheDistanceOfTheirEdges) {
  std::mt19937 random(5);
  int apart = 0;
  for (int i = 0; i < 150; ++i) {
    const Body a = random_body(random);
    const Body b = random_body(random);
    double least_m = 1e9;
    bool overlap = false;
    for (const Point2 p : edge_of(a)) {
      overlap = overlap || distance_m(b, p) <= 0.0;
      least_m = std::min(least_m, distance_m(b, p));
    }
    for (const Point2 p : edge_of(b)) overlap = overlap || distance_m(a, p) <= 0.0;
    EXPECT_NEAR(separation_m(a, b), separation_m(b, a), 1e-12);
    if (overlap) {
      EXPECT_LE(separation_m(a, b), 0.0);
      continue;
    }
    ++apart;
    EXPECT_NEAR(separation_m(a, b), least_m, 0.02);
    EXPECT_LE(separation_m(a, b), least_m + 1e-9);
  }
  EXPECT_GT(apart, 30);
}

TEST(Separation, OfOverlappingBoxesIsTheWayOut) {
  const Body a{kRectangle, {0, 0, 0}, 0, 2.0, 1.0};
  const Body b{kRectangle, {1.3, 0.0, 0}, 0, 1.0, 1.0};
  EXPECT_NEAR(separation_m(a, b), -0.2, 1e-12);
  EXPECT_NEAR(separation_m(a, {kDisc, {0.0, 0.8, 0}, 0.5, 0, 0}), -0.2, 1e-12);
}

}  // namespace
}  // namespace aisle::geometry
