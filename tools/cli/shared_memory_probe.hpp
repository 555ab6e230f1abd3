#pragma once

#include <filesystem>

#include "tools/cli/diagnosis.hpp"

namespace aisle::cli {

/// Room in `folder`, and segments of Fast DDS there that no live process has mapped; those of other users count only
/// for root.
SharedMemory probe_shared_memory(const std::filesystem::path& folder = "/dev/shm");

}  // namespace aisle::cli
