// aisle topic list: the table of topics, with the writers and readers seen.

#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "common/process/exit_code.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/text.hpp"
#include "tools/cli/topic_table.hpp"

namespace aisle::cli {
namespace {

/// How many write and read a topic.
struct Ends {
  int writers{0};
  int readers{0};
};

/// Aisle's topics in the order of the table, then foreign ones.
Json rows_as_json(const std::map<std::string, Ends>& ends, const std::set<std::string>& foreign) {
  Json rows = Json::array();
  for (const TopicRow& topic : topic_table()) {
    const auto seen = ends.find(topic.name);
    const Ends counts = seen == ends.end() ? Ends{} : seen->second;

    rows.push_back({{"topic", topic.name},
                    {"type", topic.type},
                    {"key", topic.key},
                    {"qos", text_of(topic.qos)},
                    {"writers", counts.writers},
                    {"readers", counts.readers}});
  }

  for (const std::string& name : foreign) {
    rows.push_back({{"topic", name},
                    {"type", ""},
                    {"key", ""},
                    {"qos", "not of Aisle"},
                    {"writers", ends.at(name).writers},
                    {"readers", ends.at(name).readers}});
  }

  return rows;
}

int list(const Cli& cli, double wait_s) {
  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-topic-list");
  run_until(*bus, Seconds(wait_s), [] { return false; });

  // Writers and readers of each topic; those of ours are no foreign ones.
  std::map<std::string, Ends> ends;
  std::set<std::string> foreign;

  for (const bus::Endpoint& endpoint : bus->endpoints()) {
    Ends& counts = ends[endpoint.topic];
    (endpoint.is_writer ? counts.writers : counts.readers) += 1;
    foreign.insert(endpoint.topic);
  }

  for (const TopicRow& topic : topic_table()) foreign.erase(topic.name);

  const Json rows = rows_as_json(ends, foreign);
  if (cli.json) {
    std::printf("%s\n", write_json(rows).c_str());
    return process::kDone;
  }

  std::vector<std::vector<std::string>> table{{"TOPIC", "WRITERS", "READERS", "TYPE", "KEY", "QOS"}};
  for (const Json& row : rows) {
    table.push_back({row["topic"], row["writers"].dump(), row["readers"].dump(), row["type"], row["key"], row["qos"]});
  }

  std::printf("%s", text_of_table(table).c_str());

  if (ends.empty())
    std::fprintf(stderr, "nobody seen in %s; aisle doctor looks for the cause\n", place_of(cli.settings).c_str());

  return process::kDone;
}

}  // namespace

void add_topic_list(CLI::App& parent, Cli& cli) {
  auto wait_s = std::make_shared<double>(1.5);
  Verb(parent, cli, "list", "all topics, and who writes and reads them now")
      .option("--wait", *wait_s, 0.0, 3600.0, "seconds to look")
      .runs([&cli, wait_s] { return list(cli, *wait_s); });
}

}  // namespace aisle::cli
