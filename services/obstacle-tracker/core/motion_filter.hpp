#pragma once

#include <memory>
#include <string>
#include <vector>

#include "services/obstacle-tracker/core/motions/gaussian.hpp"

namespace aisle::obstacle_tracker {

/// How things are expected to move. Each filter reads those fields that it has a use for.
struct MotionModel {
  std::string filter{"constant-velocity"};  // one of all_filters()
  double acceleration_density{0.10};        // of the white noise, m^2/s^3 an axis
  double first_speed_sigma_mps{0.9};        // of a thing just found, an axis
  double turn_density{0.2};                 // of the white noise in a turn rate's change, rad^2/s^3
  double first_turn_sigma_radps{0.3};       // of a thing just found
  double mode_s{2.0};                       // a mix: how long a thing stands, goes straight or turns, on average

  template <class Reader>
  void describe(Reader& r);
};

/// One track's motion: a belief of (x, y, vx, vy) in map, metres and metres a second, at one moment. A filter is one
/// file in core/filters/; it says there how things move, by overriding the private functions, and keeps what it needs
/// beside the common belief. After each change the common belief is the filter's summary().
class MotionFilter {
 public:
  virtual ~MotionFilter() = default;

  /// Carries the belief on by dt_s. @pre dt_s >= 0
  void predict(double dt_s) {
    move(dt_s);
    belief_ = summary();
  }

  /// The same for a thing that stands: it stays, and little doubt is added.
  void stand(double dt_s) {
    rest(dt_s);
    belief_ = summary();
  }

  /// Takes in a position in map, measured `lag_s` before the belief's moment: it is compared with where the belief says
  /// that the thing was then. `covariance`: of the position, m^2.
  void update(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance, double lag_s) {
    observe(position, covariance, lag_s);
    belief_ = summary();
  }

  /// The thing turned or started: adds doubt to the velocity, so that the next measurements set it.
  void loosen(double speed_sigma_mps) {
    doubt(speed_sigma_mps);
    belief_ = summary();
  }

  /// What update() would change, for gates and costs; changes nothing.
  Innovation innovation(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance, double lag_s) const {
    return innovation_of(belief_, position, covariance, lag_s);
  }

  const Eigen::Vector4d& state() const { return belief_.mean; }
  const Eigen::Matrix4d& covariance() const { return belief_.covariance; }

 protected:
  explicit MotionFilter(const Gaussian<4>& first) : belief_(first) {}

 private:
  virtual void move(double dt_s) = 0;
  virtual void rest(double dt_s) = 0;
  virtual void observe(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance, double lag_s) = 0;
  virtual void doubt(double speed_sigma_mps) = 0;

  /// Mean and covariance of the whole belief.
  virtual Gaussian<4> summary() const = 0;

  Gaussian<4> belief_;
};

/// One file in core/filters/ a filter: `stem.cpp` defines `Filter stem()`, and the build writes the table from the
/// files.
struct Filter {
  std::string name;     // as in configuration files
  std::string summary;  // one line
  std::unique_ptr<MotionFilter> (*make)(const MotionModel& motion, const Gaussian<4>& first);
};

/// Every filter, by name.
const std::vector<Filter>& all_filters();

/// Null when there is none of this name.
const Filter* find_filter(const std::string& name);

/// "constant-turn, constant-velocity, ..."
std::string filter_names();

/// What is believed of a thing just found.
Gaussian<4> first_belief(const MotionModel& motion, const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance);

/// The filter that `motion` names, for a thing just found. @throws std::invalid_argument when there is none of this
/// name
std::unique_ptr<MotionFilter> make_filter(const MotionModel& motion, const Eigen::Vector2d& position,
                                          const Eigen::Matrix2d& covariance);

template <class Reader>
void MotionModel::describe(Reader& r) {
  r.field("filter", filter)
      .field("acceleration_density", acceleration_density, 0.001, 100.0)
      .field("first_speed_sigma_mps", first_speed_sigma_mps, 0.05, 10.0)
      .field("turn_density", turn_density, 0.001, 100.0)
      .field("first_turn_sigma_radps", first_turn_sigma_radps, 0.001, 10.0)
      .field("mode_s", mode_s, 0.05, 1000.0);
  if (find_filter(filter) == nullptr) r.reject("filter", "'" + filter + "' is unknown; there are " + filter_names());
}

}  // namespace aisle::obstacle_tracker
