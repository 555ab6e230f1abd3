#include "tests/unit/bus/topics_page.hpp"

#include <sstream>

#include "common/bus/dds/type_table.hpp"
#include "common/bus/topics.hpp"

namespace aisle::bus_test {
namespace {

std::string history(const bus::Qos& qos) {
  if (qos.depth > 0) return "last " + std::to_string(qos.depth);
  return "all, at most " + std::to_string(qos.max_kept);
}

std::string time(std::chrono::milliseconds t) { return t.count() == 0 ? "-" : std::to_string(t.count()) + " ms"; }

std::string row(const char* name, const char* key, const char* why, const bus::Qos& qos) {
  std::ostringstream text;
  text << "| `" << name << "` | `" << bus::topic_type(name).make_support().get_type_name() << "` | " << key << " | "
       << (qos.reliability == bus::Reliability::kReliable ? "reliable" : "best effort") << " | "
       << (qos.durability == bus::Durability::kTransientLocal ? "transient local" : "volatile") << " | " << history(qos)
       << " | " << time(qos.deadline) << " | " << (qos.ownership == bus::Ownership::kExclusive ? "exclusive" : "shared")
       << " | " << time(qos.liveliness_lease) << " | " << why << " |\n";
  return text.str();
}

}  // namespace

std::string topics_page() {
  std::string page =
      "# Topics\n\n"
      "Printed from `common/bus/topics.hpp` by `build/tests/aisle_topics_page > docs/topics.md`; a test fails when it "
      "is old.\n"
      "Types are in `idl/`. Metres and radians in the map frame, stamps in nanoseconds of the Unix epoch.\n"
      "A lease means liveliness manual by topic: a writer that is silent for longer counts as gone. Queues (history "
      "\"all\")\n"
      "keep each sample until every reader has acknowledged it.\n\n"
      "| topic | type | key | reliability | durability | history | deadline | ownership | lease | why |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  topics::for_each(topics::All{}, [&](auto topic) {
    using Topic = decltype(topic);
    page += row(Topic::kName, Topic::kKey, Topic::kWhy, Topic::kQos);
  });
  return page;
}

}  // namespace aisle::bus_test
