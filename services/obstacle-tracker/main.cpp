#include <memory>

#include "common/service/run_service.hpp"
#include "services/obstacle-tracker/obstacle_tracker_service.hpp"

int main(int argc, char** argv) {
  using namespace aisle;
  obstacle_tracker::ServiceParams params;
  const auto options = [&](CLI::App&) { service::bind_config(params); };

  return service::run_service(
      argc, argv, {"obstacle-tracker", "Turns the scans of all vehicles into one set of tracks", ""}, options,
      [&](service::Shell& shell) { return std::make_unique<obstacle_tracker::ObstacleTrackerService>(shell, params); });
}
