#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

namespace aisle::time {

/// A moment on the clock of whoever calls the core: seconds as a double enter formulas, so no core asks a clock.
/// Services pass their monotonic clock; tests and the lock-step simulation pass what they like.
using Stamp = std::chrono::nanoseconds;

inline double seconds(std::chrono::nanoseconds t) { return std::chrono::duration<double>(t).count(); }
inline std::chrono::nanoseconds from_seconds(double s) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(s * 1e9));
}

/// The newest value of a stream with the moment of its arrival; read with an age limit.
template <class T>
class Latest {
 public:
  void set(T value, Stamp arrived) {
    value_ = std::move(value);
    arrived_ = arrived;
  }
  void clear() { value_.reset(); }
  bool seen() const { return value_.has_value(); }
  /// Null when there is none or it arrived more than `limit` before `now`.
  const T* fresh(Stamp now, std::chrono::nanoseconds limit) const {
    return value_ && now - arrived_ <= limit ? &*value_ : nullptr;
  }
  const T* any() const { return value_ ? &*value_ : nullptr; }
  Stamp arrived() const { return arrived_; }

 private:
  std::optional<T> value_;
  Stamp arrived_{};
};

}  // namespace aisle::time
