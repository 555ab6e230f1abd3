#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/geometry/body.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace aisle::tracking {

/// A vehicle of the fleet, as it truly stands and moves.
struct Carrier {
  std::string agv_id;
  geometry::Pose2 base_in_map;
  geometry::Twist2 twist;
  double radius_m{0.35};
};

struct Walking {
  int id{0};
  geometry::Point2 position_in_map;
  geometry::Point2 velocity_in_map;
  double radius_m{0.25};
};

/// All that is true at one moment.
struct Moment {
  std::vector<Carrier> vehicles;
  std::vector<Walking> people;
  std::vector<geometry::Body> blocks;  // unknown things that stand
};

/// What happens, apart from what anybody sees of it.
class Scene {
 public:
  virtual ~Scene() = default;
  virtual const grid::OccupancyGrid& walls() const = 0;
  virtual double duration_s() const = 0;
  virtual std::size_t vehicles() const = 0;
  /// @pre never earlier than the last time
  virtual Moment at(double t_s) = 0;
};

/// Of recordings of which nothing else is said: what fake_world::read_recording() takes them for.
inline constexpr double kUsualFramesPerS = 25.0;

/// Recorded people in an empty hall around them. The vehicles stand, or drive at 0.8 m/s, on an ellipse about the
/// middle of the people's area, where fewest people come; who walks through one is not there meanwhile, and somebody
/// else afterwards. People walk on without corners between the rows (SmoothWalk). `frames_per_s`: of the recording.
/// @throws config::BadInput
std::unique_ptr<Scene> recorded_people(const std::filesystem::path& file, int vehicles, bool drive,
                                       double frames_per_s = kUsualFramesPerS);

enum class Cast {
  kAll,
  kVehiclesOnly,  // no people, no hidden blocks: every track is a ghost
};

/// A scenario file driven on the simulated site with tracks from the truth; at most `vehicles` of its vehicles have
/// eyes (0: all).
/// @throws config::BadInput
std::unique_ptr<Scene> driven_scenario(const std::filesystem::path& file, int vehicles, std::uint64_t seed,
                                       Cast cast = Cast::kAll);

}  // namespace aisle::tracking
