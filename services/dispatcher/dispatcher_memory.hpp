#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/dispatcher/core/dispatcher.hpp"

namespace aisle::dispatcher {

/// What survives a kill -9.
struct DispatcherMemory {
  Memory missions;
  std::vector<std::string> edits_done;
  std::optional<std::int64_t> started_at_ns;  // second zero of the scenario
};

/// The text of the file; `run` names the scenario.
std::string to_text(const std::string& run, const DispatcherMemory& memory);

/// None when there is no file, it belongs to another run, or it is not what to_text() writes.
std::optional<DispatcherMemory> recall(const std::filesystem::path& file, const std::string& run);

}  // namespace aisle::dispatcher
