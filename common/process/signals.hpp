#pragma once

#include <atomic>

namespace aisle::process {

/// Becomes true at the first SIGINT or SIGTERM. Installs the handlers at the first call; a second signal ends the
/// process at once, as the shell expects (128 + signal). SIGPIPE is ignored. Call from the main thread, before others
/// start.
const std::atomic<bool>& stop_on_signals();

/// From now on the first SIGINT or SIGTERM ends the process at once (128 + signal), also one that came already: for
/// long work that is worth nothing before its end.
void end_on_signals();

}  // namespace aisle::process
