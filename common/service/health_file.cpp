#include "common/service/health_file.hpp"

#include <nlohmann/json.hpp>

#include "common/process/kept_file.hpp"

namespace aisle::service {

using nlohmann::json;

bool keep(const std::filesystem::path& file, const HealthNote& note) {
  const json kept{{"instance_id", note.instance_id},
                  {"state", static_cast<int>(note.state)},
                  {"waits_for", note.waits_for},
                  {"last_error", note.last_error},
                  {"wall_clock_ns", note.wall_clock_ns}};

  return process::keep_in_file(file, kept.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
}

/// Nothing of the file is trusted: a value that does not fit makes it no file of ours.
std::optional<HealthNote> recall_health(const std::filesystem::path& file) {
  const std::optional<std::string> text = process::read_kept_file(file);
  if (!text) return std::nullopt;

  try {
    const json kept = json::parse(*text);
    const int state = kept.at("state").get<int>();
    if (state < 0 || state > static_cast<int>(fleet::ServiceState::kStopping)) return std::nullopt;

    return HealthNote{kept.at("instance_id").get<std::string>(), static_cast<fleet::ServiceState>(state),
                      kept.at("waits_for").get<std::string>(), kept.at("last_error").get<std::string>(),
                      kept.at("wall_clock_ns").get<std::int64_t>()};
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace aisle::service
