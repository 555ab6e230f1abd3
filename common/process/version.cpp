#include "common/process/version.hpp"

namespace aisle::process {

const char* software_version() { return AISLE_VERSION; }

}  // namespace aisle::process
