#include "services/obstacle-tracker/core/motion_filter.hpp"

#include <algorithm>
#include <stdexcept>

namespace aisle::obstacle_tracker {

const Filter* find_filter(const std::string& name) {
  const std::vector<Filter>& filters = all_filters();
  const auto found =
      std::find_if(filters.begin(), filters.end(), [&](const Filter& filter) { return filter.name == name; });
  return found == filters.end() ? nullptr : &*found;
}

std::string filter_names() {
  std::string names;
  for (const Filter& filter : all_filters()) names += (names.empty() ? "" : ", ") + filter.name;
  return names;
}

Gaussian<4> first_belief(const MotionModel& motion, const Eigen::Vector2d& position,
                         const Eigen::Matrix2d& covariance) {
  Gaussian<4> first;

  // Where it was measured, and standing: nothing is known of its velocity but how fast things are.
  first.mean.head<2>() = position;
  first.covariance.topLeftCorner<2, 2>() = covariance;
  first.covariance.bottomRightCorner<2, 2>() =
      Eigen::Matrix2d::Identity() * motion.first_speed_sigma_mps * motion.first_speed_sigma_mps;

  return first;
}

std::unique_ptr<MotionFilter> make_filter(const MotionModel& motion, const Eigen::Vector2d& position,
                                          const Eigen::Matrix2d& covariance) {
  const Filter* filter = find_filter(motion.filter);
  if (filter == nullptr)
    throw std::invalid_argument("filter: '" + motion.filter + "' is unknown; there are " + filter_names());
  return filter->make(motion, first_belief(motion, position, covariance));
}

}  // namespace aisle::obstacle_tracker
