#include "services/dispatcher/dispatcher_memory.hpp"

#include <nlohmann/json.hpp>

#include "common/process/kept_file.hpp"

namespace aisle::dispatcher {

using nlohmann::json;

std::string to_text(const std::string& run, const DispatcherMemory& memory) {
  // One object a mission, by the vehicle's id.
  json missions = json::object();
  for (const auto& [id, p] : memory.missions) {
    missions[id] = {{"next", p.next}, {"reached", p.reached}, {"failed", p.failed}, {"stopped", p.stopped}};
  }

  json kept{{"run", run}, {"missions", missions}, {"edits_done", memory.edits_done}};
  if (memory.started_at_ns) kept["started_at_ns"] = *memory.started_at_ns;
  return kept.dump() + "\n";
}

std::optional<DispatcherMemory> recall(const std::filesystem::path& file, const std::string& run) {
  const std::optional<std::string> text = process::read_kept_file(file);
  if (!text) return std::nullopt;

  try {
    const json kept = json::parse(*text);
    if (kept.at("run").get<std::string>() != run) return std::nullopt;

    DispatcherMemory memory;
    for (const auto& [id, p] : kept.at("missions").items()) {
      memory.missions[id] = {p.at("next").get<std::uint64_t>(), p.at("reached").get<std::uint64_t>(),
                             p.at("failed").get<std::uint64_t>(), p.at("stopped").get<bool>()};
    }

    memory.edits_done = kept.at("edits_done").get<std::vector<std::string>>();
    if (kept.contains("started_at_ns")) memory.started_at_ns = kept.at("started_at_ns").get<std::int64_t>();
    return memory;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace aisle::dispatcher
