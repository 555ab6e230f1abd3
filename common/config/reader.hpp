#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace aisle::config {

/// Bad input from a person: one line that names file (and line), key, value, limit and remedy. Programs exit with 2.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The machine does not give what is needed (no network interface, disk full). Programs exit with 3.
class BadEnvironment : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace aisle::config
