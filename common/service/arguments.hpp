#pragma once
#include <optional>

namespace CLI {
class App;
}

namespace aisle::service {

/// Parses, with the nearest flag or verb named for one that is unknown. An exit code when --help or --version was asked
/// for and printed. @throws config::BadInput
std::optional<int> parse_arguments(CLI::App& app, int argc, const char* const* argv);

}  // namespace aisle::service
