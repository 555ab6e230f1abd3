#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "tools/cli/json.hpp"

namespace aisle::cli {

/// A sample of any topic.
struct Received {
  bus::SampleInfo info;
  std::string key;                // values of the key fields, "agv-1" or "hall/3/4"
  std::size_t bytes{0};           // serialized
  std::function<Json()> to_json;  // only while the handler runs; with the key fields alone when the instance is gone
};

/// One row of common/bus/topics.hpp without its type.
struct TopicRow {
  std::string name;
  std::string type;  // as on the wire, "aisle::Plan"
  std::string key;   // names of the key fields
  bus::Qos qos;
  std::string why;

  /// Calls `handler` for every sample and end of an instance.
  void (*subscribe)(bus::Bus& bus, std::function<void(const Received&)> handler);
};

/// All topics in the order of topics.hpp.
const std::vector<TopicRow>& topic_table();

/// The row with this name. @throws config::BadInput with the nearest name
const TopicRow& find_topic(const std::string& name);

/// Other processes do not announce how much history they keep.
enum class History { kKnown, kNotAnnounced };

/// "reliable, transient local, keep last 1, ..."
std::string text_of(const bus::Qos& qos, History history = History::kKnown);

}  // namespace aisle::cli
