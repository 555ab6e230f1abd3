#include "common/bus/qos_conflict.hpp"

#include <fnmatch.h>

#include <algorithm>

namespace aisle::bus {
namespace {

std::string period(std::chrono::milliseconds t) { return t.count() == 0 ? "none" : std::to_string(t.count()) + " ms"; }

/// Is what is offered at least as tight? 0 means infinite.
bool covers(std::chrono::milliseconds offered, std::chrono::milliseconds requested) {
  return requested.count() == 0 || (offered.count() > 0 && offered <= requested);
}

}  // namespace

/// Requested against offered, policy by policy, as in DDS 1.4, section 2.2.3; the first that does not
/// fit is named.
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

/// The type first: with another type no QoS matters.
std::optional<Incident> mismatch(const Announced& ours, const Announced& theirs, const std::string& participant) {
  const std::string their_end = (theirs.is_writer ? "writer " : "reader ") + participant;
  if (ours.type != theirs.type) {
    return Incident{
        Incident::Kind::kTypeMismatch, ours.topic,
        ours.topic + ": " + their_end + " uses type " + theirs.type + ", ours is " + ours.type + "; no samples pass"};
  }

  if (ours.is_writer == theirs.is_writer) return std::nullopt;

  const Announced& writer = ours.is_writer ? ours : theirs;
  const Announced& reader = ours.is_writer ? theirs : ours;

  const std::string conflict = qos_conflict(writer.qos, writer.manual_liveliness, reader.qos, reader.manual_liveliness);
  if (conflict.empty()) return std::nullopt;

  return Incident{Incident::Kind::kIncompatibleQos, ours.topic,
                  ours.topic + ": " + their_end + " does not fit our QoS: " + conflict + "; no samples pass"};
}

bool same_partition(const std::string& ours, const std::vector<std::string>& theirs) {
  if (theirs.empty()) return ours.empty();
  return std::any_of(theirs.begin(), theirs.end(), [&](const std::string& name) {
    return name == ours || fnmatch(name.c_str(), ours.c_str(), 0) == 0 || fnmatch(ours.c_str(), name.c_str(), 0) == 0;
  });
}

}  // namespace aisle::bus
