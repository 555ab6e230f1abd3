#pragma once
#include <chrono>
#include <string>

namespace aisle::cli {

/// What a person sees on stderr of what takes longer than kPatience: a line that is written anew on a terminal, one
/// every kPause elsewhere.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void tell(const std::string& text);
  /// Before anything else is printed.
  void clear();

  static constexpr std::chrono::milliseconds kPatience{2000};
  static constexpr std::chrono::milliseconds kPause{5000};

 private:
  bool is_terminal_;
  bool is_shown_{false};
  std::chrono::steady_clock::time_point next_;
};

}  // namespace aisle::cli
