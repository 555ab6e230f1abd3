#include "common/process/leaving.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace aisle::process {
namespace {

constexpr std::string_view kLine = "the middleware aborted while this process was leaving; all its work was done\n";

/// A signal handler: only calls that are safe there (write, _exit).
void end(int) {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kLine.data(), kLine.size());
  _exit(0);
}

}  // namespace

void take_an_abort_for_the_end() { std::signal(SIGABRT, end); }

}  // namespace aisle::process
