#include "common/process/signals.hpp"

#include <csignal>

namespace aisle::process {
namespace {

std::atomic<bool> stop_requested{false};

static_assert(std::atomic<bool>::is_always_lock_free, "the signal handler may only touch lock-free atomics");

void request_stop(int) { stop_requested.store(true); }

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

}  // namespace aisle::process
