// aisle topic info: one topic's contract, and each writer and reader seen.

#include <cstdio>
#include <memory>
#include <string>

#include "common/process/exit_code.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/text.hpp"
#include "tools/cli/topic_table.hpp"

namespace aisle::cli {
namespace {

/// Our own row of the table, then the endpoints that others announce.
int show_topic(const Cli& cli, const std::string& name, double wait_s) {
  const TopicRow& topic = find_topic(name);
  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-topic-info");

  run_until(*bus, Seconds(wait_s), [] { return false; });

  Json ends = Json::array();
  for (const bus::Endpoint& endpoint : bus->endpoints()) {
    if (endpoint.topic != topic.name) continue;

    ends.push_back({{"role", endpoint.is_writer ? "writer" : "reader"},
                    {"participant", endpoint.participant},
                    {"host", endpoint.host},
                    {"type", endpoint.type},
                    {"qos", text_of(endpoint.qos, History::kNotAnnounced)}});
  }

  Json report{
      {"topic", topic.name}, {"type", topic.type}, {"key", topic.key}, {"qos", text_of(topic.qos)}, {"why", topic.why}};
  if (cli.json) {
    report["endpoints"] = std::move(ends);
    std::printf("%s\n", write_json(report).c_str());
    return process::kDone;
  }

  std::printf("%s\n", text_of_sample(report, Length::kFull).c_str());

  std::vector<std::vector<std::string>> table{{"ROLE", "PARTICIPANT", "HOST", "TYPE", "QOS"}};
  for (const Json& end : ends) table.push_back({end["role"], end["participant"], end["host"], end["type"], end["qos"]});
  std::printf("%s", text_of_table(table).c_str());

  return process::kDone;
}

}  // namespace

void add_topic_info(CLI::App& parent, Cli& cli) {
  struct Options {
    std::string topic;
    double wait_s{1.5};
  };

  auto options = std::make_shared<Options>();
  Verb(parent, cli, "info", "one topic: type, key, QoS, and who writes and reads it now")
      .argument("topic", options->topic, "name, e.g. plan")
      .option("--wait", options->wait_s, 0.0, 3600.0, "seconds to look")
      .runs([&cli, options] { return show_topic(cli, options->topic, options->wait_s); });
}

}  // namespace aisle::cli
