#pragma once
#include <string>

namespace aisle::demo {

/// What a person sees while a run goes on: one line that is rewritten on a terminal, one every kEvery lines of the
/// referee elsewhere; and events on lines of their own.
class Progress {
 public:
  explicit Progress(bool is_terminal);
  /// A JSON line is progress; others are shown as they are.
  void referee_line(const std::string& line);
  void say(const std::string& text);

  static constexpr int kEvery = 5;

 private:
  void clear_line();
  bool is_terminal_;
  bool line_is_open_{false};
  int count_{0};
};

}  // namespace aisle::demo
