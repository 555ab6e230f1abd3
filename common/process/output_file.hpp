#pragma once

#include <string>

namespace aisle::process {

/// Checks, before work that may take minutes, that `file` can be created or overwritten. @throws
/// config::BadEnvironment
void check_writable(const std::string& file);

/// Replaces the file by `text`. @throws config::BadEnvironment
void write_output_file(const std::string& file, const std::string& text);

}  // namespace aisle::process
