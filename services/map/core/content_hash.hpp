#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "common/fleet/map_edit.hpp"
#include "common/fleet/zone.hpp"

namespace aisle::map {

/// FNV-1a, 64 bits (Fowler, Noll, Vo): hash = (hash xor byte) * prime, byte by byte. Tells contents apart; it is no
/// protection against somebody who looks for equal hashes.
class ContentHash {
 public:
  /// Of a number or an enumerator: its bytes.
  template <class Number>
  ContentHash& mix(const Number& value) {
    unsigned char bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    for (const unsigned char byte : bytes) hash_ = (hash_ ^ byte) * 1099511628211ULL;

    return *this;
  }

  ContentHash& mix(const std::string& text) {
    for (const char c : text) mix(c);
    return mix(text.size());
  }

  ContentHash& mix(const std::vector<geometry::Point2>& points) {
    for (const geometry::Point2 point : points) mix(point.x).mix(point.y);
    return *this;
  }

  ContentHash& mix(const fleet::Zone& zone) {
    return mix(zone.id)
        .mix(zone.kind)
        .mix(zone.shape)
        .mix(zone.points_in_map)
        .mix(zone.radius_m)
        .mix(zone.max_speed_mps)
        .mix(zone.direction_rad);
  }

  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_{14695981039346656037ULL};
};

}  // namespace aisle::map
