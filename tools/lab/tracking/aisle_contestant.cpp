#include "tools/lab/tracking/contestant.hpp"

namespace aisle::tracking {
namespace {

/// The core of aisle-obstacle-tracker without its service.
class Aisle final : public Contestant {
 public:
  explicit Aisle(const obstacle_tracker::TrackerParams& params) : name_(params.motion.filter), tracker_(params) {}
  std::string name() const override { return name_; }

  void take(const obstacle_tracker::Scan& scan, const std::vector<obstacle_tracker::KnownVehicle>& vehicles,
            const grid::ClearanceField& clearance, time::Stamp now) override {
    static_cast<void>(tracker_.take(scan, vehicles, &clearance, now));
  }

  std::vector<fleet::Track> tracks(time::Stamp now) const override { return tracker_.tracks(now); }

 private:
  std::string name_;
  obstacle_tracker::Tracker tracker_;
};

}  // namespace

std::unique_ptr<Contestant> make_aisle(const obstacle_tracker::TrackerParams& params) {
  return std::make_unique<Aisle>(params);
}

std::unique_ptr<Contestant> make_aisle(const std::string& filter) {
  obstacle_tracker::TrackerParams params;
  params.motion.filter = filter;
  return make_aisle(params);
}

}  // namespace aisle::tracking
