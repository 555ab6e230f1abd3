#pragma once

#include <optional>

namespace CLI {
class App;
}

namespace aisle::service {

/// Parses the command line. Returns an exit code when --help or --version was asked for and printed.
/// @throws config::BadInput for a flag or verb that is unknown (with the nearest known one) or a value
/// that does not fit
std::optional<int> parse_arguments(CLI::App& app, int argc, const char* const* argv);

}  // namespace aisle::service
