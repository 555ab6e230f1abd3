#include "tools/lab/tracking/jumps.hpp"

#include <cmath>
#include <optional>

#include "services/fake-world/core/recording.hpp"

namespace aisle::tracking {
namespace {

using geometry::Point2;

/// Sums over all people.
struct Sums {
  double speeds{0.0}, squares{0.0}, products{0.0};
  int pieces{0}, jumps{0}, pairs{0};

  void add(const std::vector<fake_world::RecordedPerson::Row>& rows) {
    std::optional<Point2> velocity, jump;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double step_s = rows[i].t_s - rows[i - 1].t_s;
      const Point2 next = (1.0 / step_s) * (rows[i].in_map - rows[i - 1].in_map);

      speeds += geometry::norm(next);
      ++pieces;
      if (velocity) add(next - *velocity, jump);
      velocity = next;
    }
  }

 private:
  /// `before`: the jump at the row before, if there was one.
  void add(Point2 jump, std::optional<Point2>& before) {
    squares += geometry::dot(jump, jump);
    ++jumps;

    if (before) {
      products += geometry::dot(jump, *before);
      ++pairs;
    }

    before = jump;
  }
};

}  // namespace

/// Nothing for a recording of which no person has four rows.
Jumps jumps_of(const std::filesystem::path& recording) {
  scenario::Recording of;
  of.file = recording;

  Sums sums;
  for (const fake_world::RecordedPerson& person : fake_world::read_recording(of)) sums.add(person.rows());

  if (sums.pairs == 0) return {};

  const double mean_square = sums.squares / sums.jumps;
  return {sums.speeds / sums.pieces, std::sqrt(mean_square), sums.products / sums.pairs / mean_square};
}

}  // namespace aisle::tracking
