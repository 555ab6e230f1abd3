#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"
#include "common/scenario/scenario.hpp"

namespace aisle::fake_world {

/// Where a person is and how they move, in map.
struct Motion {
  geometry::Point2 position_in_map;
  geometry::Point2 velocity_in_map;  // m/s
};

/// One recorded person in map, on the recording's clock (0 at the file's first row). Exists from its first row to its
/// last.
class RecordedPerson {
 public:
  /// One observation: seconds since the file's first row, and the place.
  struct Row {
    double t_s;
    geometry::Point2 in_map;
  };

  /// @pre rows in order of time, at least one
  RecordedPerson(std::string id, std::vector<Row> rows);

  const std::string& id() const { return id_; }

  /// Place and velocity at `t_s`, straight and at constant speed between rows; none before the first row and after the
  /// last.
  std::optional<Motion> at(double t_s) const;

  const std::vector<Row>& rows() const { return rows_; }

 private:
  std::string id_;
  std::vector<Row> rows_;
};

/// Reads `frame id x y` rows, times them by the recording's frames a second and puts them into map by the recording's
/// pose. People who are there only outside of begin_s..end_s are left out. Ids are "<file's stem>-<number>".
/// @throws config::BadInput with file:line for rows that are no numbers, files over 64 MiB, and files without rows
std::vector<RecordedPerson> read_recording(const scenario::Recording& recording);

}  // namespace aisle::fake_world
