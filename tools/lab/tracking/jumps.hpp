#pragma once

#include <filesystem>

namespace aisle::tracking {

/// How a recording's people move when they walk straight from row to row: their velocity jumps at every row.
struct Jumps {
  double mean_speed_mps{0.0};  // of all pieces between rows
  double rms_mps{0.0};         // root mean square of the jumps' lengths

  /// Of each jump with the one before: mean scalar product over mean square. Even walking, recorded with
  /// independent errors of the places, gives -2/3 (differences 1, -2, 1); independent jumps give 0.
  double correlation{0.0};
};

/// @throws config::BadInput when the recording cannot be read
Jumps jumps_of(const std::filesystem::path& recording);

}  // namespace aisle::tracking
