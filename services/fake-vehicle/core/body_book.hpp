#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/geometry/body.hpp"
#include "common/time/stamp.hpp"

namespace aisle::fake_vehicle {

/// The bodies of all other things in the world, by id, where they were heard of last. A body stays when its simulator
/// falls silent: a dead vehicle blocks its place. Things which a restarted world (a larger boot id) does not show again
/// within a second are dropped, as they had gone while it was away.
class BodyBook {
 public:
  /// `own_id`: the vehicle itself, whose body is left out.
  explicit BodyBook(std::string own_id);

  /// A body was heard of, in map. At most 4096 ids are kept; further ones are ignored.
  /// @param is_vehicle it is simulated by a process of its own, not by the world
  /// @param boot_id of the process that simulates it
  void seen(const std::string& id, const geometry::Body& body, bool is_vehicle, std::uint64_t boot_id, time::Stamp now);

  /// Its simulator said that it has left.
  void gone(const std::string& id);

  /// Drops what only the world before its restart has shown, once the new one had a second to show it again.
  void forget_old_world(time::Stamp now);

  /// In order of their ids.
  const std::vector<geometry::Body>& bodies() const { return bodies_; }

 private:
  struct Entry {
    geometry::Body body;
    bool is_vehicle{false};
    std::uint64_t boot_id{0};
  };

  /// Copies the bodies of entries_ to bodies_.
  void list();

  std::string own_id_;
  std::map<std::string, Entry> entries_;
  std::vector<geometry::Body> bodies_;
  std::uint64_t world_boot_id_{0};  // of the newest process that simulates the world
  time::Stamp world_since_{};       // when it was first heard
};

}  // namespace aisle::fake_vehicle
