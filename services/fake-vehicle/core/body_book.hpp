#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/geometry/body.hpp"
#include "common/time/stamp.hpp"

namespace aisle::fake_vehicle {

/// All other bodies, by id, as they were last heard of. A body stays where it was when its simulator falls silent: a
/// dead vehicle blocks its place. What a restarted world does not show again within a second is gone, as it was gone
/// before.
class BodyBook {
 public:
  explicit BodyBook(std::string own_id);

  /// `is_vehicle`: simulated by a process of its own. `boot_id`: of the process that simulates it.
  void seen(const std::string& id, const geometry::Body& body, bool is_vehicle, std::uint64_t boot_id, time::Stamp now);
  void gone(const std::string& id);
  void forget_old_world(time::Stamp now);

  const std::vector<geometry::Body>& bodies() const { return bodies_; }

 private:
  struct Entry {
    geometry::Body body;
    bool is_vehicle{false};
    std::uint64_t boot_id{0};
  };
  void list();

  std::string own_id_;
  std::map<std::string, Entry> entries_;
  std::vector<geometry::Body> bodies_;
  std::uint64_t world_boot_id_{0};
  time::Stamp world_since_{};
};

}  // namespace aisle::fake_vehicle
