#pragma once

#include <atomic>

namespace aisle::process {

/// Becomes true at the first SIGINT or SIGTERM. Installs the handlers at the first call; a second signal ends the
/// process at once, as the shell expects (128 + signal). SIGPIPE is ignored. Call from the main thread, before others
/// start.
const std::atomic<bool>& stop_on_signals();

}  // namespace aisle::process
