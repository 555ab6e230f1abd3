#pragma once

// What every decoder does with a sample from the wire: it is distrusted until each field was looked at.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace aisle::wire {

/// A decoded value, or the reason why the sample must not be used. Reasons name the field, its value and the limit.
template <class T>
class [[nodiscard]] Decoded {
 public:
  Decoded(T value) : value_(std::move(value)) {}  // NOLINT(google-explicit-constructor): `return value;` in a decoder

  /// A sample that must not be used, and why.
  static Decoded refused(std::string reason) {
    Decoded none;
    none.reason_ = std::move(reason);
    return none;
  }

  explicit operator bool() const { return value_.has_value(); }

  /// @pre there is a value
  const T& operator*() const& { return *value_; }
  T&& operator*() && { return std::move(*value_); }
  const T* operator->() const { return &*value_; }

  /// Empty when there is a value.
  const std::string& reason() const { return reason_; }

 private:
  Decoded() = default;

  std::optional<T> value_;
  std::string reason_;
};

/// Checks one sample, field by field, and keeps the first reason. All bounds are inclusive; a NaN is within no bounds.
///   Checks checks;
///   checks.within("radius_m", sample.radius_m(), 0.0, 10.0).id("edit_id", edit.edit_id);
///   if (!checks.ok()) return Decoded<Edit>::refused(checks.reason());
class Checks {
 public:
  /// Not NaN and not infinite.
  Checks& finite(const char* field, double value) {
    return std::isfinite(value) ? *this : refuse(field, " is not a finite number");
  }

  /// low <= value <= high.
  Checks& within(const char* field, double value, double low, double high) {
    return value >= low && value <= high
               ? *this
               : refuse(field, " = " + text(value) + " is not within " + text(low) + " and " + text(high));
  }

  /// Number of elements of a sequence.
  Checks& count(const char* field, std::size_t size, std::size_t low, std::size_t high) {
    return size >= low && size <= high ? *this
                                       : refuse(field, " has " + std::to_string(size) + " elements, not " +
                                                           std::to_string(low) + " to " + std::to_string(high));
  }

  /// An identifier that must not be empty and has no control characters (it ends up in logs and file names).
  Checks& id(const char* field, const std::string& value) {
    return value.empty() ? refuse(field, " is empty") : optional_id(field, value);
  }

  /// The same, but it may be empty: "none".
  Checks& optional_id(const char* field, const std::string& value) {
    return has_control_characters(value) ? refuse(field, " has control characters") : *this;
  }

  /// An enumerator, of the wire's enum, that stands for `ours`; none: the number is no enumerator.
  template <class Theirs, class Ours>
  Ours known(const char* field, Theirs value, std::optional<Ours> ours) {
    if (!ours) refuse(field, " = " + std::to_string(static_cast<long long>(value)) + " is no known value");
    return ours.value_or(Ours{});
  }

  /// Any other condition; `what` is the whole reason when it does not hold.
  Checks& holds(bool condition, const char* what) { return condition ? *this : refuse(what, ""); }

  /// Has every check passed so far?
  bool ok() const { return reason_.empty(); }
  const std::string& reason() const { return reason_; }

  /// What a decoder returns: the value when every check passed, else the first reason.
  template <class T>
  Decoded<T> decoded(T value) const {
    return ok() ? Decoded<T>(std::move(value)) : Decoded<T>::refused(reason_);
  }

  static bool has_control_characters(const std::string& text) {
    return std::any_of(text.begin(), text.end(),
                       [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
  }

 private:
  static std::string text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.9g", value);
    return buffer;
  }

  Checks& refuse(const char* field, const std::string& why) {
    if (reason_.empty()) reason_ = field + why;
    return *this;
  }

  std::string reason_;
};

}  // namespace aisle::wire
