#include "common/service/health.hpp"

#include <cstddef>

namespace aisle::service {
namespace {

constexpr std::size_t kMostCounters = 32;
constexpr std::size_t kLongestWait = 200;  // characters; service_health has room for 256

}  // namespace

void Health::count(const std::string& name, std::uint64_t by) {
  const auto position = counters.find(name);
  if (position != counters.end()) {
    position->second += by;
  } else if (counters.size() < kMostCounters) {
    counters.emplace(name, by);
  }
}

void Health::tell_map(const std::string& id, std::uint64_t revision, std::uint64_t hash) {
  map_id = id;
  map_revision = revision;
  map_hash = hash;
}

void Health::wait_for(const std::string& what) {
  if (waits_for.size() >= kLongestWait) return;
  waits_for += (waits_for.empty() ? "" : ", ") + what;
}

}  // namespace aisle::service
