#pragma once
#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/bus/dds/dds_bus.hpp"
#include "common/service/map_client.hpp"
#include "common/wire/map.hpp"

namespace aisle::map::testing {

inline bus::Settings local_settings(int domain, const std::string& name) {
  bus::Settings settings;
  settings.domain = domain;
  settings.interfaces = {"127.0.0.1"};
  settings.participant_name = name;
  return settings;
}

inline fleet::MapEdit rectangle(const std::string& id, fleet::MapEdit::Action action, geometry::Point2 low,
                                geometry::Point2 high) {
  return {id, "floor", action, fleet::MapEdit::Shape::kRectangle, {low, high}, 0.0};
}

/// Whoever uses the map: a mirror, and edits with their results.
class Site {
 public:
  explicit Site(int domain, const std::string& name = "mirror")
      : bus(local_settings(domain, name)), map(bus, name, {}) {
    edits_ = bus.writer<topics::MapEdit>();
    zone_edits_ = bus.writer<topics::ZoneEdit>();
    bus.on<topics::MapEditResult>([this](const aisle::MapEditResult& sample, const bus::SampleInfo& info) {
      if (info.kind != bus::SampleKind::kData) return;
      const auto result = wire::decode(sample);
      if (result) results[result->edit_id] = *result;
    });
  }
  bool can_send() const { return edits_.matched_readers() > 0 && zone_edits_.matched_readers() > 0; }
  void send(const fleet::MapEdit& edit) { send_raw(wire::encode(edit)); }
  void send_raw(aisle::MapEdit sample) {
    sample.by().source_id("test");
    sample.by().sequence_number(++sent_);
    if (!edits_.write(sample)) std::fprintf(stderr, "write failed\n");
  }

  void send(const fleet::ZoneEdit& edit) {
    aisle::ZoneEdit sample = wire::encode(edit);
    sample.by().source_id("test");
    sample.by().sequence_number(++sent_);
    if (!zone_edits_.write(sample)) std::fprintf(stderr, "write failed\n");
  }

  bus::DdsBus bus;
  service::MapClient map;
  std::map<std::string, fleet::MapEditResult> results;

 private:
  bus::Writer<topics::MapEdit> edits_;
  bus::Writer<topics::ZoneEdit> zone_edits_;
  std::uint64_t sent_{0};
};

/// Runs the buses until the condition holds; false after the limit.
inline bool run_until(const std::vector<bus::Bus*>& buses, const std::function<bool()>& done,
                      std::chrono::seconds limit = std::chrono::seconds(20)) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!done() && std::chrono::steady_clock::now() < end) {
    for (bus::Bus* bus : buses) bus->run_once(std::chrono::milliseconds(5));
  }
  return done();
}

}  // namespace aisle::map::testing
