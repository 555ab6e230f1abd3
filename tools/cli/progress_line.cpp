#include "tools/cli/progress_line.hpp"

#include <unistd.h>

#include <cstdio>

namespace aisle::cli {
namespace {

constexpr std::chrono::milliseconds kRewrite{200};

}  // namespace

ProgressLine::ProgressLine()
    : is_terminal_(isatty(STDERR_FILENO) == 1), next_(std::chrono::steady_clock::now() + kPatience) {}

ProgressLine::~ProgressLine() { clear(); }

/// Too soon after the last one: nothing is shown.
void ProgressLine::tell(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;

  next_ = now + (is_terminal_ ? kRewrite : kPause);
  std::fprintf(stderr, is_terminal_ ? "\r\033[K%s" : "%s\n", text.c_str());
  std::fflush(stderr);
  is_shown_ = is_terminal_;
}

void ProgressLine::clear() {
  if (!is_shown_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  is_shown_ = false;
}

}  // namespace aisle::cli
