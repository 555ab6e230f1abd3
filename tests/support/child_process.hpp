#pragma once
#include <sys/types.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace aisle::test_support {

/// A program that runs beside the test, with its output in pipes. Ended (SIGKILL) when the object goes.
class ChildProcess {
 public:
  /// `environment` is added to the test's own. Aborts the test program when it cannot be started.
  explicit ChildProcess(const std::vector<std::string>& command,
                        const std::map<std::string, std::string>& environment = {});
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  void signal(int number);
  /// Reads output until the process ends, at most `limit`. Exit code, 128 + signal, or nothing when it still runs.
  std::optional<int> wait(std::chrono::milliseconds limit);
  /// Reads output until stdout or stderr holds `text`. False when it does not within `limit` or the process ended
  /// without.
  bool wait_for_output(const std::string& text, std::chrono::milliseconds limit);
  const std::string& out() const { return out_; }
  const std::string& err() const { return err_; }

 private:
  bool read_some(std::chrono::milliseconds limit);
  bool has_ended();

  pid_t pid_{-1};
  int out_fd_{-1};
  int err_fd_{-1};
  std::string out_;
  std::string err_;
  std::optional<int> code_;
};

}  // namespace aisle::test_support
