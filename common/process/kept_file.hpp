#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace aisle::process {

/// Keeps a small state so that it survives a kill -9: written under a temporary name, then renamed, so
/// that a reader finds the old text or the new, never a mixture. False when that was not possible (disk
/// full, no such folder).
bool keep_in_file(const std::filesystem::path& file, const std::string& text);

/// The text kept before; none when there is no such file, or it is larger than 64 KiB.
std::optional<std::string> read_kept_file(const std::filesystem::path& file);

}  // namespace aisle::process
