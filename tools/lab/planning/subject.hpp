#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "tools/lab/planning/drawn_map.hpp"
#include "tools/lab/planning/queries.hpp"

namespace aisle::lab {

/// A place as a person gives it, in metres and radians; without a yaw every heading will do.
struct Place {
  geometry::Point2 in_map;
  std::optional<double> yaw_rad{};
};

/// What a person says of a map and of what is asked there.
struct SubjectOrders {
  std::filesystem::path map;  // any file that read_lab_map takes
  double cell_m{0.0};         // 0: not said
  std::optional<Place> start{};
  std::optional<Place> goal{};
  std::filesystem::path scen{};  // queries of a file, as read_queries takes them; empty: none
  std::size_t limit{1'000'000};  // at most so many of them
};

/// A map with the questions that are asked there.
struct Subject {
  grid::OccupancyGrid grid;
  std::vector<Query> queries;             // at least one
  std::optional<double> start_yaw_rad{};  // of a single query; none: any
  std::optional<double> goal_yaw_rad{};
};

/// Reads the map, and the queries of a file, or the one from start to goal; where one of these is not given, the map's
/// own S or T counts.
/// @throws config::BadInput with file or flag, what is wrong, and what to do
Subject read_subject(const SubjectOrders& orders);

}  // namespace aisle::lab
