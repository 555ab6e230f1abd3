#pragma once

namespace aisle::process {

/// "0.1.0": of the whole project, from CMakeLists.txt.
const char* software_version();

}  // namespace aisle::process
