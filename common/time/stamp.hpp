#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace aisle::time {

/// A moment on the clock of the caller of a core, since an arbitrary beginning: cores are given the
/// time and ask no clock. Services pass the monotonic clock of their bus; tests and the simulated site
/// pass what they like.
using Stamp = std::chrono::nanoseconds;

/// A duration as a number for formulas, in seconds.
inline double seconds(std::chrono::nanoseconds t) { return std::chrono::duration<double>(t).count(); }

/// The duration of `s` seconds, cut to whole nanoseconds. @pre |s| < 9e9
inline std::chrono::nanoseconds from_seconds(double s) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(s * 1e9));
}

/// The newest value of a stream with the moment of its arrival; read with an age limit.
template <class T>
class Latest {
 public:
  /// Replaces the value before.
  void set(T value, Stamp arrived) {
    value_ = std::move(value);
    arrived_ = arrived;
  }

  void clear() { value_.reset(); }

  /// Has there been a value since the start, or the last clear()?
  bool seen() const { return value_.has_value(); }

  /// The value, or null when there is none or it arrived more than `limit` before `now`.
  const T* fresh(Stamp now, std::chrono::nanoseconds limit) const {
    return value_ && now - arrived_ <= limit ? &*value_ : nullptr;
  }

  /// The value, however old; null when there is none.
  const T* any() const { return value_ ? &*value_ : nullptr; }

  /// When the newest value arrived; zero before the first.
  Stamp arrived() const { return arrived_; }

 private:
  std::optional<T> value_;
  Stamp arrived_{};
};

}  // namespace aisle::time
