#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/dispatcher/core/dispatcher.hpp"
#include "services/dispatcher/core/task_pool.hpp"

namespace aisle::dispatcher {

/// What the state file keeps, so that missions and tasks go on after the process was killed.
struct DispatcherMemory {
  Memory missions;
  std::vector<TaskProgress> tasks;
  std::vector<std::string> edits_done;
  std::optional<std::int64_t> started_at_ns;  // second zero of the scenario
};

/// The text of the state file, JSON in one line. `run` names the scenario.
std::string to_text(const std::string& run, const DispatcherMemory& memory);

/// Reads what to_text() wrote. None when there is no file, when it belongs to another run, and when it is broken.
std::optional<DispatcherMemory> recall(const std::filesystem::path& file, const std::string& run);

}  // namespace aisle::dispatcher
