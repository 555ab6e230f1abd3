#pragma once

namespace aisle::process {

/// E.g. "0.2.0": of the whole project, from CMakeLists.txt.
const char* software_version();

}  // namespace aisle::process
