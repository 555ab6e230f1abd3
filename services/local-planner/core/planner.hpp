#pragma once
#include <memory>

#include "services/local-planner/core/critic.hpp"
#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/settings.hpp"

namespace aisle::local_planner {

/// Drives one vehicle along its plan, 50 times a second: what is known comes in, a command and a status come out.
/// Deterministic: the same calls give the same outputs. Not for several threads.
class Planner {
 public:
  virtual ~Planner() = default;

  /// One cycle. `now` never goes back; call it every `Settings::control_period_s`.
  virtual Output step(const Inputs& inputs, time::Stamp now) = 0;

 protected:
  Planner() = default;
  Planner(const Planner&) = default;
  Planner& operator=(const Planner&) = default;
};

/// The site's planner (`LocalPlanner`), or with `Settings::as_printed` the variant as its paper prints it
/// (`PrintedPlanner`).
std::unique_ptr<Planner> make_planner(const Settings& settings, const Variant& variant);

}  // namespace aisle::local_planner
