#pragma once
#include <string>

namespace aisle::process {

/// Before what may take minutes: can `file` be made or written anew? @throws config::BadEnvironment
void check_writable(const std::string& file);

/// @throws config::BadEnvironment
void write_output_file(const std::string& file, const std::string& text);

}  // namespace aisle::process
