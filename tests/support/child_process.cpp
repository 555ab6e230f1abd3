#include "tests/support/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace aisle::test_support {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// False at the end of the stream.
bool append(int fd, std::string& text) {
  char buffer[4096];
  const ssize_t count = read(fd, buffer, sizeof buffer);
  if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
  return count != 0;
}

[[noreturn]] void become(const std::vector<std::string>& command, const std::map<std::string, std::string>& environment,
                         int out, int err) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // no orphan when the test dies first
  for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  std::perror(arguments[0]);
  _exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command,
                           const std::map<std::string, std::string>& environment) {
  int out[2];
  int err[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) std::abort();
  pid_ = fork();
  if (pid_ < 0) std::abort();
  if (pid_ == 0) become(command, environment, out[1], err[1]);
  close(out[1]);
  close(err[1]);
  out_fd_ = out[0];
  err_fd_ = err[0];
}

ChildProcess::~ChildProcess() {
  if (!has_ended()) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (out_fd_ >= 0) close(out_fd_);
  if (err_fd_ >= 0) close(err_fd_);
}

void ChildProcess::signal(int number) { kill(pid_, number); }

bool ChildProcess::has_ended() {
  int status = 0;
  if (!code_ && waitpid(pid_, &status, WNOHANG) == pid_)
    code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return code_.has_value();
}

bool ChildProcess::read_some(milliseconds limit) {
  pollfd fds[2] = {{out_fd_, POLLIN, 0}, {err_fd_, POLLIN, 0}};  // a negative fd is skipped
  if (out_fd_ < 0 && err_fd_ < 0) return false;
  if (poll(fds, 2, static_cast<int>(std::max<milliseconds::rep>(limit.count(), 0))) <= 0)
    return true;  // a negative limit would be for ever
  if (fds[0].revents != 0 && !append(out_fd_, out_)) close(std::exchange(out_fd_, -1));
  if (fds[1].revents != 0 && !append(err_fd_, err_)) close(std::exchange(err_fd_, -1));
  return true;
}

std::optional<int> ChildProcess::wait(milliseconds limit) {
  const auto end = Clock::now() + limit;
  while (Clock::now() < end) {
    const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now());
    if (!read_some(std::min(left, milliseconds(100)))) {
      int status = 0;
      if (!code_ && waitpid(pid_, &status, 0) == pid_)
        code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      return code_;
    }
  }
  return std::nullopt;
}

bool ChildProcess::wait_for_output(const std::string& text, milliseconds limit) {
  const auto end = Clock::now() + limit;
  const auto has_text = [&] { return out_.find(text) != std::string::npos || err_.find(text) != std::string::npos; };
  while (!has_text() && Clock::now() < end) {
    const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now());
    if (!read_some(std::min(left, milliseconds(100)))) break;
  }
  return has_text();
}

}  // namespace aisle::test_support
