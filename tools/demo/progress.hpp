#pragma once

#include <string>

namespace aisle::demo {

/// What a person sees while a run goes on: in a terminal one line that is rewritten, elsewhere every
/// kEvery-th line of the referee; events on lines of their own.
class Progress {
 public:
  /// `is_terminal`: of stdout.
  explicit Progress(bool is_terminal);

  /// A line of the referee: JSON is progress; everything else is shown as it is.
  void referee_line(const std::string& line);

  /// An event, on a line of its own.
  void say(const std::string& text);

  static constexpr int kEvery = 5;

 private:
  void clear_line();

  bool is_terminal_;
  bool line_is_open_{false};
  int count_{0};
};

}  // namespace aisle::demo
