#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace aisle::process {

/// Small state that a process keeps over a kill -9: written under a temporary name, then renamed, so that whoever reads
/// sees the old text or the new, never a mixture. False when that was not possible (disk full, no such folder).
bool keep_in_file(const std::filesystem::path& file, const std::string& text);

/// What was kept; none when there is no such file, or it is larger than 64 KiB.
std::optional<std::string> read_kept_file(const std::filesystem::path& file);

}  // namespace aisle::process
