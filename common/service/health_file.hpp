#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/fleet/health.hpp"

namespace aisle::service {

/// The part of a service's last `service_health` that a healthcheck on the same host needs. Kept in a
/// file, because a check that joins the site anew costs more than the service that it checks.
struct HealthNote {
  std::string instance_id;
  fleet::ServiceState state{};
  std::string waits_for;
  std::string last_error;
  std::int64_t wall_clock_ns{0};  // when it was said
};

/// Replaces the file. False when it cannot be written.
bool keep(const std::filesystem::path& file, const HealthNote& note);

/// None when there is no such file, or it is not one of ours.
std::optional<HealthNote> recall_health(const std::filesystem::path& file);

}  // namespace aisle::service
