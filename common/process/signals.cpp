#include "common/process/signals.hpp"

#include <csignal>

namespace aisle::process {
namespace {

std::atomic<bool> stop_requested{false};
std::atomic<int> requested_by{0};  // the signal

static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "the signal handler may only touch lock-free atomics");

void request_stop(int signal) {
  requested_by.store(signal);
  stop_requested.store(true);
}

/// SA_RESETHAND: the handler serves once, so that a second signal ends the process.
void install() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace

const std::atomic<bool>& stop_on_signals() {
  static const bool installed = (install(), true);
  static_cast<void>(installed);
  return stop_requested;
}

void end_on_signals() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (stop_requested.load()) std::raise(requested_by.load());
}

}  // namespace aisle::process
