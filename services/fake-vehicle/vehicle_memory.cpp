#include "services/fake-vehicle/vehicle_memory.hpp"

#include <nlohmann/json.hpp>

#include "common/process/kept_file.hpp"

namespace aisle::fake_vehicle {

using nlohmann::json;

bool keep(const std::filesystem::path& file, const VehicleMemory& memory) {
  const json kept{{"run", memory.run},
                  {"base_in_map", {memory.base_in_map.x, memory.base_in_map.y, memory.base_in_map.yaw}},
                  {"accepted_epoch", memory.accepted_epoch}};
  return process::keep_in_file(file, kept.dump() + "\n");
}

std::optional<VehicleMemory> recall(const std::filesystem::path& file, const std::string& run) {
  const std::optional<std::string> text = process::read_kept_file(file);
  if (!text) return std::nullopt;

  try {
    const json kept = json::parse(*text);

    VehicleMemory memory;
    memory.run = kept.at("run").get<std::string>();

    const json& base = kept.at("base_in_map");
    memory.base_in_map = {base.at(0).get<double>(), base.at(1).get<double>(), base.at(2).get<double>()};

    memory.accepted_epoch = kept.at("accepted_epoch").get<std::uint32_t>();
    if (memory.run != run || !geometry::is_finite(memory.base_in_map)) return std::nullopt;

    return memory;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace aisle::fake_vehicle
