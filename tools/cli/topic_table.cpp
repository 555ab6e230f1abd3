#include "tools/cli/topic_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/bus/inspect.hpp"
#include "common/bus/topics.hpp"
#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"

namespace aisle::cli {
namespace {

/// The names of a list with ", " between them.
std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(", ", begin), list.size());
    names.push_back(list.substr(begin, end - begin));
    begin = end + 2;
  }

  return names;
}

std::string text_of_key(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// The key fields of a sample.
Json only_key(const Json& sample, const std::string& key_fields) {
  Json key = Json::object();
  for (const std::string& field : names_in(key_fields)) key[field] = sample.at(field);
  return key;
}

/// The one place where a sample's type is known.
template <class Topic>
void subscribe(bus::Bus& bus, std::function<void(const Received&)> handler) {
  bus.on<Topic>([handler = std::move(handler)](const typename Topic::Sample& sample, const bus::SampleInfo& info) {
    const Json key = only_key(to_json(sample), Topic::kKey);
    Received received;

    received.info = info;

    for (const auto& member : key.items())
      received.key += (received.key.empty() ? "" : "/") + text_of_key(member.value());

    received.bytes = bus::serialized_bytes(Topic::kName, &sample);

    const bool is_data = info.kind == bus::SampleKind::kData;
    received.to_json = [&] { return is_data ? to_json(sample) : key; };
    handler(received);
  });
}

/// Of one topic of topics.hpp.
template <class Topic>
TopicRow row() {
  return {Topic::kName, bus::type_name(Topic::kName), Topic::kKey, Topic::kQos, Topic::kWhy, &subscribe<Topic>};
}

}  // namespace

const std::vector<TopicRow>& topic_table() {
  static const std::vector<TopicRow> table = [] {
    std::vector<TopicRow> rows;
    topics::for_each(topics::All{}, [&rows](auto topic) { rows.push_back(row<decltype(topic)>()); });
    return rows;
  }();

  return table;
}

const TopicRow& find_topic(const std::string& name) {
  std::vector<std::string> names;
  for (const TopicRow& topic : topic_table()) {
    if (topic.name == name) return topic;
    names.push_back(topic.name);
  }

  const std::string nearest = config::nearest_name(name, names);
  throw config::BadInput("unknown topic '" + name + "'; " +
                         (nearest.empty() ? "see aisle topic list" : "did you mean '" + nearest + "'?"));
}

/// Policies that are at their default are not named.
std::string text_of(const bus::Qos& qos, History history) {
  std::string text = qos.reliability == bus::Reliability::kReliable ? "reliable" : "best effort";
  if (qos.durability == bus::Durability::kTransientLocal) text += ", transient local";
  if (history == History::kKnown) text += qos.depth == 0 ? ", keep all" : fmt::format(", keep last {}", qos.depth);
  if (qos.deadline.count() > 0) text += fmt::format(", deadline {} ms", qos.deadline.count());
  if (qos.ownership == bus::Ownership::kExclusive) text += ", exclusive";
  if (qos.liveliness_lease.count() > 0) text += fmt::format(", lease {} ms", qos.liveliness_lease.count());

  return text;
}

}  // namespace aisle::cli
