// aisle topic hz, aisle topic bw: how often and how much is said on a topic, by instance.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <set>
#include <string>

#include "common/process/exit_code.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/rates.hpp"
#include "tools/cli/text.hpp"
#include "tools/cli/topic_table.hpp"

namespace aisle::cli {
namespace {

/// The flags with their defaults.
struct RateOptions {
  std::string topic;
  std::string key;
  double seconds{5.0};
};

/// Listens for that long.
Rates measure(const Cli& cli, const RateOptions& options) {
  const TopicRow& topic = find_topic(options.topic);
  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-topic-rate");
  Rates rates;

  // What a late joiner gets first was written before, and says nothing about the rate.
  const bool begins_with_history = topic.qos.durability == bus::Durability::kTransientLocal;
  std::set<std::string> begun;

  topic.subscribe(*bus, [&](const Received& received) {
    const bool is_wanted = options.key.empty() || received.key == options.key;
    if (!is_wanted || received.info.kind != bus::SampleKind::kData) return;
    const bool is_history = begun.insert(received.key).second && begins_with_history;
    if (!is_history) rates[received.key].add(received.info.arrived, received.bytes);
  });

  run_until(*bus, Seconds(options.seconds), [] { return false; });

  if (rates.empty()) {
    std::fprintf(stderr, "no sample on '%s' in %g s; %d writers seen in %s\n", topic.name.c_str(), options.seconds,
                 bus->matched_writers(topic.name), place_of(cli.settings).c_str());
  }

  return rates;
}

/// `heading` and `cells`: the columns for a person; JSON has all figures.
int print_rates(const Cli& cli, const RateOptions& options, const std::vector<std::string>& heading,
                const std::function<std::vector<std::string>(const Rate&)>& cells) {
  const Rates rates = measure(cli, options);
  if (cli.json) {
    for (const auto& [key, rate] : rates) {
      const Json row{{"topic", options.topic},
                     {"key", key},
                     {"samples", rate.samples()},
                     {"hz", rate.hz()},
                     {"mean_gap_ms", rate.mean_gap_ms()},
                     {"longest_gap_ms", rate.longest_gap_ms()},
                     {"mean_bytes", rate.mean_bytes()},
                     {"bytes_per_s", rate.bytes_per_s()}};
      std::printf("%s\n", write_json(row).c_str());
    }
  } else if (!rates.empty()) {
    std::vector<std::vector<std::string>> table{heading};
    for (const auto& [key, rate] : rates) {
      std::vector<std::string> row{key};
      for (std::string& cell : cells(rate)) row.push_back(std::move(cell));
      table.push_back(std::move(row));
    }

    std::printf("%s", text_of_table(table).c_str());
  }

  return rates.empty() ? process::kNegative : process::kDone;
}

int print_hz(const Cli& cli, const RateOptions& options) {
  return print_rates(cli, options, {"KEY", "HZ", "MEAN GAP ms", "LONGEST GAP ms", "SAMPLES"}, [](const Rate& rate) {
    return std::vector<std::string>{fmt::format("{:.2f}", rate.hz()), fmt::format("{:.1f}", rate.mean_gap_ms()),
                                    fmt::format("{:.1f}", rate.longest_gap_ms()), std::to_string(rate.samples())};
  });
}

int print_bw(const Cli& cli, const RateOptions& options) {
  return print_rates(cli, options, {"KEY", "KB/S", "MEAN BYTES", "HZ", "SAMPLES"}, [](const Rate& rate) {
    return std::vector<std::string>{fmt::format("{:.2f}", rate.bytes_per_s() / 1e3),
                                    fmt::format("{:.0f}", rate.mean_bytes()), fmt::format("{:.2f}", rate.hz()),
                                    std::to_string(rate.samples())};
  });
}

void add_rate_verb(CLI::App& parent, Cli& cli, const char* name, const char* purpose,
                   int (*run)(const Cli&, const RateOptions&)) {
  auto options = std::make_shared<RateOptions>();
  Verb(parent, cli, name, purpose)
      .argument("topic", options->topic, "name, e.g. velocity_command")
      .option("--key", options->key, "only this instance, e.g. agv-1")
      .option("--seconds", options->seconds, 0.1, 86400.0, "how long to measure")
      .runs([&cli, options, run] { return run(cli, *options); });
}

}  // namespace

void add_topic_hz(CLI::App& parent, Cli& cli) {
  add_rate_verb(parent, cli, "hz", "samples per second, and gaps, by instance", &print_hz);
}

void add_topic_bw(CLI::App& parent, Cli& cli) {
  add_rate_verb(parent, cli, "bw", "serialized bytes per second, by instance", &print_bw);
}

}  // namespace aisle::cli
