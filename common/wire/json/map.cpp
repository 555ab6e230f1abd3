#include "common/wire/json/parts.hpp"

namespace aisle::wire {
namespace {

constexpr std::array kActions{"block", "unblock"};
constexpr std::array kShapes{"rectangle", "polygon", "disc"};
constexpr std::array kEditOutcomes{"applied", "already_applied", "refused"};

std::string name_of(aisle::EditOutcome outcome) { return enumerator_name(kEditOutcomes, outcome); }

}  // namespace

Json to_json(const aisle::MapInfo& sample) {
  Json hashes = Json::array();
  for (const std::uint64_t hash : sample.tile_hashes()) hashes.push_back(hexadecimal(hash));
  return Json{{"map_id", sample.map_id().to_string()},
              {"by", to_json(sample.by())},
              {"revision", sample.revision()},
              {"width_cells", sample.width_cells()},
              {"height_cells", sample.height_cells()},
              {"resolution_m", sample.resolution_m()},
              {"origin_in_map", to_json(sample.origin_in_map())},
              {"tile_size_cells", sample.tile_size_cells()},
              {"hash", hexadecimal(sample.hash())},
              {"tile_hashes", std::move(hashes)}};
}

Json to_json(const aisle::MapTile& sample) {
  Json cells = Json::array();
  for (const auto cell : sample.cells()) cells.push_back(static_cast<unsigned>(cell));
  return Json{
      {"map_id", sample.map_id().to_string()}, {"tile_x", sample.tile_x()},          {"tile_y", sample.tile_y()},
      {"revision", sample.revision()},         {"hash", hexadecimal(sample.hash())}, {"cells", std::move(cells)}};
}

Json to_json(const aisle::MapRequest& sample) {
  return Json{{"requester_id", sample.requester_id().to_string()},
              {"map_id", sample.map_id().to_string()},
              {"sequence_number", sample.sequence_number()},
              {"tiles", sample.tiles()}};
}

Json to_json(const aisle::MapEdit& sample) {
  return Json{{"edit_id", sample.edit_id().to_string()},
              {"by", to_json(sample.by())},
              {"map_id", sample.map_id().to_string()},
              {"action", enumerator_name(kActions, sample.action())},
              {"shape", enumerator_name(kShapes, sample.shape())},
              {"points", array_of(sample.points())},
              {"radius_m", sample.radius_m()}};
}

Json to_json(const aisle::MapEditResult& sample) {
  return Json{{"edit_id", sample.edit_id().to_string()}, {"by", to_json(sample.by())},
              {"map_id", sample.map_id().to_string()},   {"outcome", name_of(sample.outcome())},
              {"detail", sample.detail().to_string()},   {"revision", sample.revision()},
              {"changed_cells", sample.changed_cells()}};
}

}  // namespace aisle::wire
