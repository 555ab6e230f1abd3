#include "services/fake-vehicle/core/body_book.hpp"

#include <iterator>
#include <utility>

namespace aisle::fake_vehicle {
namespace {

constexpr std::size_t kMostBodies = 4096;
constexpr std::chrono::seconds kGrace{1};  // in which a restarted world shows its things again

}  // namespace

BodyBook::BodyBook(std::string own_id) : own_id_(std::move(own_id)) {}

void BodyBook::seen(const std::string& id, const geometry::Body& body, bool is_vehicle, std::uint64_t boot_id,
                    time::Stamp now) {
  if (id == own_id_ || (entries_.size() >= kMostBodies && entries_.count(id) == 0)) return;

  if (!is_vehicle && boot_id > world_boot_id_) {
    world_boot_id_ = boot_id;
    world_since_ = now;
  }

  entries_[id] = {body, is_vehicle, boot_id};
  list();
}

void BodyBook::gone(const std::string& id) {
  if (entries_.erase(id) > 0) list();
}

void BodyBook::forget_old_world(time::Stamp now) {
  if (now - world_since_ < kGrace) return;

  bool changed = false;
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    const bool is_old = !entry->second.is_vehicle && entry->second.boot_id < world_boot_id_;
    changed = changed || is_old;
    entry = is_old ? entries_.erase(entry) : std::next(entry);
  }

  if (changed) list();
}

void BodyBook::list() {
  bodies_.clear();
  for (const auto& [id, entry] : entries_) bodies_.push_back(entry.body);
}

}  // namespace aisle::fake_vehicle
