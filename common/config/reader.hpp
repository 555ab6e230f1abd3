#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace aisle::config {

/// Bad input from a person, as one line that names file (and line), key, value, limit and remedy.
/// Programs exit with 2. Line ends and other control characters that came with the input show as '?'.
class BadInput : public std::runtime_error {
 public:
  explicit BadInput(const std::string& what) : std::runtime_error(one_line(what)) {}

 private:
  static std::string one_line(std::string text) {
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    }

    return text;
  }
};

/// The machine does not give what is needed (no network interface, disk full). Programs exit with 3.
class BadEnvironment : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace aisle::config
