#include "services/fake-world/world_memory.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/process/kept_file.hpp"

namespace aisle::fake_world {

using nlohmann::json;

bool keep(const std::filesystem::path& file, const std::string& run, const Memory& memory) {
  json walkers = json::object();
  for (const auto& [id, progress] : memory.walkers) walkers[id] = {progress.along_m, progress.back, progress.waited_s};

  const json kept{{"run", run}, {"seconds", memory.seconds}, {"walkers", walkers}, {"present", memory.present}};

  return process::keep_in_file(file, kept.dump() + "\n");
}

std::optional<Memory> recall(const std::filesystem::path& file, const std::string& run) {
  const std::optional<std::string> text = process::read_kept_file(file);
  if (!text) return std::nullopt;

  try {
    const json kept = json::parse(*text);
    if (kept.at("run").get<std::string>() != run) return std::nullopt;

    Memory memory;

    memory.seconds = kept.at("seconds").get<double>();
    memory.present = kept.at("present").get<std::set<std::string>>();

    // As keep() writes them: [along_m, back, waited_s].
    for (const auto& [id, progress] : kept.at("walkers").items()) {
      memory.walkers[id] = {progress.at(0).get<double>(), progress.at(1).get<bool>(), progress.at(2).get<double>()};
    }

    return std::isfinite(memory.seconds) ? std::optional<Memory>(memory) : std::nullopt;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace aisle::fake_world
