#include "common/bus/qos_conflict.hpp"

namespace aisle::bus {
namespace {

std::string period(std::chrono::milliseconds t) { return t.count() == 0 ? "none" : std::to_string(t.count()) + " ms"; }

/// Is what is offered at least as tight? 0 means infinite.
bool covers(std::chrono::milliseconds offered, std::chrono::milliseconds requested) {
  return requested.count() == 0 || (offered.count() > 0 && offered <= requested);
}

}  // namespace

std::string qos_conflict(const Qos& offered, bool offers_manual_liveliness, const Qos& requested,
                         bool asks_manual_liveliness) {
  if (offered.reliability == Reliability::kBestEffort && requested.reliability == Reliability::kReliable) {
    return "reliability: best effort is offered, reliable is asked for";
  }
  if (offered.durability == Durability::kVolatile && requested.durability == Durability::kTransientLocal) {
    return "durability: volatile is offered, transient local is asked for";
  }
  if (offered.ownership != requested.ownership) {
    const bool exclusive = offered.ownership == Ownership::kExclusive;
    return std::string("ownership: ") + (exclusive ? "exclusive is offered, shared" : "shared is offered, exclusive") +
           " is asked for";
  }
  if (!covers(offered.deadline, requested.deadline)) {
    return "deadline: " + period(offered.deadline) + " is offered, " + period(requested.deadline) + " is asked for";
  }
  if (asks_manual_liveliness && !offers_manual_liveliness) {
    return "liveliness: automatic is offered, manual by topic is asked for";
  }
  if (!covers(offered.liveliness_lease, requested.liveliness_lease)) {
    return "liveliness lease: " + period(offered.liveliness_lease) + " is offered, " +
           period(requested.liveliness_lease) + " is asked for";
  }
  return {};
}

}  // namespace aisle::bus
