#include "common/bus/reader_incidents.hpp"

namespace aisle::bus {
namespace {

constexpr std::chrono::seconds kQuietTime{5};

}  // namespace

Incident malformed_sample(const std::string& topic, const std::string& type, const std::string& participant) {
  return {Incident::Kind::kMalformedSample, topic,
          topic + ": a sample of " + participant + " is not of type " + type + "; dropped"};
}

Incident liveliness_lost(const std::string& topic, const Qos& qos, const std::string& participant) {
  return {Incident::Kind::kLivelinessLost, topic,
          topic + ": writer " + participant + " is silent for more than " +
              std::to_string(qos.liveliness_lease.count()) + " ms"};
}

Incident deadline_missed(const std::string& topic, const Qos& qos, std::int64_t total) {
  return {Incident::Kind::kDeadlineMissed, topic,
          topic + ": nothing new for more than " + std::to_string(qos.deadline.count()) + " ms, " +
              std::to_string(total) + " times in all"};
}

Incident samples_rejected(const std::string& topic, std::int64_t total) {
  return {Incident::Kind::kSampleRejected, topic,
          topic + ": " + std::to_string(total) + " samples rejected in all: no room"};
}

bool QuietTime::allows(Incident::Kind kind, time::Stamp now) {
  const auto last = reported_.find(kind);
  if (last != reported_.end() && now - last->second < kQuietTime) return false;
  reported_[kind] = now;
  return true;
}

}  // namespace aisle::bus
