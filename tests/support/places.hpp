#pragma once
#include <filesystem>
#include <string>

namespace aisle::test_support {

// Absolute paths of this build. They are compiled into one small file: as macros on every test's command line they
// would keep two checkouts from sharing a compiler cache.

/// The top of the source tree.
std::filesystem::path source_folder();
/// The folder of the programs (build/bin).
std::filesystem::path program_folder();
/// Path of the program `name` in build/bin, e.g. "aisle-map".
std::string program(const std::string& name);
/// Path of a program that is built only for tests, e.g. "bus_test_peer".
std::string test_program(const std::string& name);

}  // namespace aisle::test_support
