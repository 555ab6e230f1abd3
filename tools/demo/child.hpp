#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "tools/demo/fleet.hpp"

namespace aisle::demo {

/// How a process ended.
struct Ending {
  bool by_signal{false};
  int code{0};  // exit code or signal

  /// As a process ends that was asked to.
  bool clean() const { return !by_signal && code == 0; }
  std::string text() const;  // "exit code 2", "signal 9"
};

/// A process that we started and end by its id. It dies with us. It does not get our terminal's Ctrl-C:
/// we stop it in order.
class Child {
 public:
  /// stderr (and stdout, unless it is piped to us) goes to `log`, appended. @throws std::system_error when it cannot be
  /// started
  Child(const Process& process, const std::filesystem::path& program, const std::filesystem::path& log,
        bool pipe_stdout);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t pid() const { return pid_; }

  /// Read end of its stdout, or -1. Does not block.
  int stdout_fd() const { return stdout_fd_; }

  /// Does nothing when it has ended.
  void send(int signal) const;

  /// How it ended; none while it runs. Does not wait.
  std::optional<Ending> poll();

 private:
  pid_t pid_{-1};
  int stdout_fd_{-1};
  std::optional<Ending> ending_;
};

/// The last line that is not empty, at most 300 characters of it; empty when there is none.
std::string last_line(const std::filesystem::path& log);

}  // namespace aisle::demo
