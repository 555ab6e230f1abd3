#pragma once

#include <functional>
#include <string>

namespace aisle::process {

/// What a program's exit code tells its caller.
enum ExitCode : int {
  kDone = 0,
  kNegative = 1,     // it worked, and the answer is no; or a fault of ours
  kBadInput = 2,     // a flag, file or name that does not fit
  kEnvironment = 3,  // the machine or the network does not give what is needed
};

/// Runs `body` and returns its exit code. Turns config::BadInput into one line on stderr and kBadInput,
/// config::BadEnvironment into kEnvironment, any other exception into kNegative; never a stack trace.
int run_guarded(const std::string& program, const std::function<int()>& body);

}  // namespace aisle::process
