#include <algorithm>
#include <cmath>
#include <limits>

#include "common/config/reader.hpp"
#include "services/fake-world/core/recording.hpp"
#include "tools/lab/tracking/scene.hpp"
#include "tools/lab/tracking/smooth_walk.hpp"

namespace aisle::tracking {
namespace {

using fake_world::RecordedPerson;
using geometry::Point2;
using geometry::Pose2;

constexpr double kHallMargin_m = 3.0;  // from the people's area to the hall's walls
constexpr double kCell_m = 0.05;
constexpr double kSpeed_mps = 0.8;  // of vehicles that drive
constexpr double kPersonRadius_m = 0.25;
constexpr double kCarrierRadius_m = 0.35;
constexpr int kSteps = 720;  // of the ellipse

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The least rectangle that holds all places.
struct Area {
  Point2 low{kInfinity, kInfinity};
  Point2 high{-kInfinity, -kInfinity};
};

Area area_of(const std::vector<RecordedPerson>& people) {
  Area area;
  for (const RecordedPerson& person : people) {
    for (const RecordedPerson::Row& row : person.rows()) {
      area.low = {std::min(area.low.x, row.in_map.x), std::min(area.low.y, row.in_map.y)};
      area.high = {std::max(area.high.x, row.in_map.x), std::max(area.high.y, row.in_map.y)};
    }
  }

  return area;
}

/// A hall whose only walls are its edge.
grid::OccupancyGrid hall_around(const Area& area) {
  grid::Geometry geometry;
  geometry.resolution_m = kCell_m;
  geometry.origin_in_map = area.low - Point2{kHallMargin_m, kHallMargin_m};
  geometry.width = static_cast<int>(std::ceil((area.high.x - area.low.x + 2.0 * kHallMargin_m) / kCell_m));
  geometry.height = static_cast<int>(std::ceil((area.high.y - area.low.y + 2.0 * kHallMargin_m) / kCell_m));

  if (geometry.cells() > 100'000'000) throw config::BadInput("the people's area is too large for a hall around it");

  grid::OccupancyGrid walls(geometry);
  for (int x = 0; x < geometry.width; ++x) {
    walls.set({x, 0}, grid::Occupancy::kOccupied);
    walls.set({x, geometry.height - 1}, grid::Occupancy::kOccupied);
  }

  for (int y = 0; y < geometry.height; ++y) {
    walls.set({0, y}, grid::Occupancy::kOccupied);
    walls.set({geometry.width - 1, y}, grid::Occupancy::kOccupied);
  }

  return walls;
}

/// An ellipse that is driven counter-clockwise at one speed.
class Ellipse {
 public:
  explicit Ellipse(const Area& area)
      : center_(0.5 * (area.low + area.high)),
        half_x_m_(0.3 * (area.high.x - area.low.x)),
        half_y_m_(0.3 * (area.high.y - area.low.y)) {
    along_m_.push_back(0.0);
    for (int i = 1; i <= kSteps; ++i)
      along_m_.push_back(along_m_.back() + geometry::distance(point(angle(i - 1)), point(angle(i))));
  }

  double length_m() const { return along_m_.back(); }

  /// At `way_m` along the ellipse, heading along it. Turn rate of a drive: v ab / ((a sin)^2 + (b cos)^2)^(3/2), speed
  /// times curvature, with a and b the half axes.
  Carrier carrier_at(double way_m, bool drives) const {
    const double left_m = std::fmod(way_m, length_m());
    const auto later = std::upper_bound(along_m_.begin(), along_m_.end() - 1, left_m);
    const auto i = static_cast<int>(later - along_m_.begin());
    const double before_m = along_m_[static_cast<std::size_t>(i - 1)];
    const double a = angle(i - 1) + (angle(i) - angle(i - 1)) * (left_m - before_m) / (*later - before_m);
    Carrier carrier;

    carrier.radius_m = kCarrierRadius_m;

    const Point2 at = point(a);
    carrier.base_in_map = {at.x, at.y, std::atan2(half_y_m_ * std::cos(a), -half_x_m_ * std::sin(a))};

    const double speed_of_angle = std::hypot(half_x_m_ * std::sin(a), half_y_m_ * std::cos(a));
    if (drives) carrier.twist = {kSpeed_mps, kSpeed_mps * half_x_m_ * half_y_m_ / std::pow(speed_of_angle, 3), 0.0};

    return carrier;
  }

 private:
  /// Of step i of the ellipse, in radians.
  static double angle(int i) { return 2.0 * geometry::kPi * i / kSteps; }
  Point2 point(double a) const { return center_ + Point2{half_x_m_ * std::cos(a), half_y_m_ * std::sin(a)}; }

  Point2 center_;
  double half_x_m_, half_y_m_;
  std::vector<double> along_m_;
};

/// People as recorded, vehicles on an ellipse among them. A person that walks through a vehicle is not there meanwhile
/// and is somebody new after it.
class RecordedPeople final : public Scene {
 public:
  RecordedPeople(const std::vector<RecordedPerson>& people, int vehicles, bool drive, double hurry)
      : walls_(hall_around(area_of(people))), ellipse_(area_of(people)), vehicles_(vehicles), drive_(drive) {
    for (const RecordedPerson& person : people) {
      people_.emplace_back(person.rows(), hurry);
      duration_s_ = std::max(duration_s_, people_.back().end_s());
    }

    ids_.resize(people_.size());
    for (std::size_t p = 0; p < people_.size(); ++p) ids_[p].id = next_id_++;
    choose_place();
  }

  const grid::OccupancyGrid& walls() const override { return walls_; }
  double duration_s() const override { return duration_s_; }
  std::size_t vehicles() const override { return static_cast<std::size_t>(vehicles_); }

  /// People within a vehicle are left out, and get another id when they come out of it.
  Moment at(double t_s) override {
    Moment moment;
    moment.vehicles = carriers(t_s, place_m_);

    for (std::size_t p = 0; p < people_.size(); ++p) {
      const auto motion = people_[p].at(t_s);
      if (!motion) continue;

      if (is_inside(motion->position_in_map, moment.vehicles)) {
        ids_[p].was_inside = true;
        continue;
      }

      if (ids_[p].was_inside) ids_[p] = {next_id_++, false};
      moment.people.push_back({ids_[p].id, motion->position_in_map, motion->velocity_in_map, kPersonRadius_m});
    }

    return moment;
  }

 private:
  /// A recorded person's id, and whether it was within a vehicle at the moment before.
  struct Identity {
    int id{0};
    bool was_inside{false};
  };

  /// All vehicles, evenly spread over the ellipse.
  std::vector<Carrier> carriers(double t_s, double place_m) const {
    std::vector<Carrier> carriers;
    for (int i = 0; i < vehicles_; ++i) {
      const double way_m = place_m + i * ellipse_.length_m() / vehicles_ + (drive_ ? kSpeed_mps * t_s : 0.0);
      carriers.push_back(ellipse_.carrier_at(way_m, drive_));
      carriers.back().agv_id = "agv-" + std::to_string(i + 1);
    }

    return carriers;
  }

  /// Does a person there overlap one of the vehicles?
  static bool is_inside(Point2 in_map, const std::vector<Carrier>& carriers) {
    return std::any_of(carriers.begin(), carriers.end(), [in_map](const Carrier& carrier) {
      return geometry::distance(carrier.base_in_map.position(), in_map) < carrier.radius_m + kPersonRadius_m;
    });
  }

  /// Puts the first vehicle where vehicles and people overlap least over the whole recording.
  void choose_place() {
    constexpr int kPlaces = 24;
    constexpr double kRow_s = 0.4;  // of the recordings
    std::size_t fewest = static_cast<std::size_t>(-1);

    for (int i = 0; i < kPlaces; ++i) {
      const double place_m = i * ellipse_.length_m() / (kPlaces * std::max(1, vehicles_));
      std::size_t inside = 0;

      for (double t_s = 0.0; t_s < duration_s_; t_s += kRow_s) {
        const std::vector<Carrier> there = carriers(t_s, place_m);
        for (const SmoothWalk& person : people_) {
          const auto motion = person.at(t_s);
          if (motion && is_inside(motion->position_in_map, there)) ++inside;
        }
      }

      if (inside >= fewest) continue;

      fewest = inside;
      place_m_ = place_m;
    }
  }

  std::vector<SmoothWalk> people_;
  grid::OccupancyGrid walls_;
  Ellipse ellipse_;
  int vehicles_;
  bool drive_;
  double duration_s_{0.0};
  double place_m_{0.0};  // of the first vehicle, along the ellipse
  std::vector<Identity> ids_;
  int next_id_{1};
};

}  // namespace

std::unique_ptr<Scene> recorded_people(const std::filesystem::path& file, int vehicles, bool drive,
                                       double frames_per_s) {
  scenario::Recording recording;
  recording.file = file;
  return std::make_unique<RecordedPeople>(fake_world::read_recording(recording), vehicles, drive,
                                          frames_per_s / kUsualFramesPerS);
}

}  // namespace aisle::tracking
