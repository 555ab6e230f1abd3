#pragma once

#include <chrono>
#include <string>

namespace aisle::cli {

/// Shows on stderr that something takes longer than kPatience: a line that is rewritten in a terminal,
/// a new line every kPause elsewhere.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows `text`, unless a line was shown just before.
  void tell(const std::string& text);

  /// Removes the line; to be called before anything else is printed.
  void clear();

  static constexpr std::chrono::milliseconds kPatience{2000};
  static constexpr std::chrono::milliseconds kPause{5000};

 private:
  bool is_terminal_;
  bool is_shown_{false};
  std::chrono::steady_clock::time_point next_;
};

}  // namespace aisle::cli
