#include "tools/demo/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <system_error>
#include <vector>

namespace aisle::demo {
namespace {

constexpr int kCannotExec = 127;

/// Throws what errno says.
[[noreturn]] void fail(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

/// In the new process, until it becomes the program: only calls that are safe after a fork.
[[noreturn]] void become(const char* program, char* const* arguments, int log_fd, int stdout_fd, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kCannotExec);  // the parent died before the line above

  setpgid(0, 0);
  dup2(stdout_fd >= 0 ? stdout_fd : log_fd, STDOUT_FILENO);
  dup2(log_fd, STDERR_FILENO);

  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
  signal(SIGPIPE, SIG_DFL);

  execv(program, arguments);
  _exit(kCannotExec);
}

}  // namespace

std::string Ending::text() const { return fmt::format("{} {}", by_signal ? "signal" : "exit code", code); }

/// fork and exec. The parent's ends of the log and of the pipe are closed in the child by O_CLOEXEC.
Child::Child(const Process& process, const std::filesystem::path& program, const std::filesystem::path& log,
             bool pipe_stdout) {
  const int log_fd = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (log_fd < 0) fail("cannot write " + log.string());

  int pipe_fds[2] = {-1, -1};
  if (pipe_stdout && pipe2(pipe_fds, O_CLOEXEC) != 0) fail("cannot make a pipe");

  // argv, ended by a null pointer.
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), process.arguments.begin(), process.arguments.end());

  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  // The child becomes the program; the parent closes its copies of the child's ends.
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) become(program.c_str(), arguments.data(), log_fd, pipe_fds[1], parent);

  close(log_fd);
  if (pipe_fds[1] >= 0) close(pipe_fds[1]);
  if (pid_ < 0) fail("cannot start " + process.program);

  stdout_fd_ = pipe_fds[0];
  if (stdout_fd_ >= 0) fcntl(stdout_fd_, F_SETFL, O_NONBLOCK);
}

Child::~Child() {
  if (!poll()) {
    send(SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  if (stdout_fd_ >= 0) close(stdout_fd_);
}

void Child::send(int signal) const {
  if (pid_ > 0 && !ending_) kill(pid_, signal);
}

/// waitpid(2) once; the ending is kept, since it can be had only once.
std::optional<Ending> Child::poll() {
  if (ending_) return ending_;

  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;

  ending_ = WIFSIGNALED(status) ? Ending{true, WTERMSIG(status)} : Ending{false, WEXITSTATUS(status)};
  return ending_;
}

/// Reads the last 4 kB only.
std::string last_line(const std::filesystem::path& log) {
  constexpr std::streamoff kTail = 4096;
  constexpr std::size_t kLongest = 300;

  std::ifstream in(log, std::ios::binary | std::ios::ate);
  if (!in) return {};

  in.seekg(std::max<std::streamoff>(0, static_cast<std::streamoff>(in.tellg()) - kTail));

  std::string line;
  std::string last;

  while (std::getline(in, line)) {
    if (!line.empty()) last = line;
  }

  return last.substr(0, kLongest);
}

}  // namespace aisle::demo
