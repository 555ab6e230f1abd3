// aisle topic echo: prints what is said on a topic.

#include <cstdio>
#include <memory>
#include <string>

#include "common/process/exit_code.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/text.hpp"
#include "tools/cli/topic_table.hpp"

namespace aisle::cli {
namespace {

/// The flags with their defaults.
struct EchoOptions {
  std::string topic;
  std::string key;
  int count{0};  // 0: without end
  bool once{false};
  bool full{false};
  double timeout_s{0.0};
};

constexpr Seconds kUntilHint{2.0};
constexpr Seconds kForever{1e9};

/// A sample, or the line that an instance is gone.
void print_sample(const Cli& cli, const EchoOptions& options, const Received& received) {
  const bool is_data = received.info.kind == bus::SampleKind::kData;
  const char* gone = received.info.kind == bus::SampleKind::kDisposed ? "disposed" : "no_writers";

  if (cli.json) {
    Json json = received.to_json();
    if (!is_data) json["gone"] = gone;
    std::printf("%s\n", write_json(json).c_str());
  } else if (is_data) {
    std::printf("%s---\n", text_of_sample(received.to_json(), options.full ? Length::kFull : Length::kShort).c_str());
  } else {
    std::printf("%s: %s\n---\n", gone, printable(received.key).c_str());
  }

  std::fflush(stdout);
}

/// Prints samples until enough came or the time is over; after kUntilHint without one it says how many
/// writers there are.
int echo(const Cli& cli, const EchoOptions& options) {
  const TopicRow& topic = find_topic(options.topic);
  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-topic-echo");
  const int wanted = options.once ? 1 : options.count;
  int printed = 0;

  topic.subscribe(*bus, [&](const Received& received) {
    if (wanted > 0 && printed >= wanted) return;
    if (!options.key.empty() && received.key != options.key) return;

    // When a number of samples is asked for, only data counts, not that a writer left.
    if (wanted > 0 && received.info.kind != bus::SampleKind::kData) return;

    print_sample(cli, options, received);
    ++printed;
  });

  const auto done = [&] { return wanted > 0 && printed >= wanted; };
  const Seconds limit = options.timeout_s > 0.0 ? Seconds(options.timeout_s) : kForever;

  run_until(*bus, std::min(limit, kUntilHint), [&] { return done() || printed > 0; });

  if (printed == 0 && !is_interrupted()) {
    std::fprintf(stderr, "no sample on '%s'%s yet; %d writers seen in %s\n", topic.name.c_str(),
                 options.key.empty() ? "" : (" with key '" + printable(options.key) + "'").c_str(),
                 bus->matched_writers(topic.name), place_of(cli.settings).c_str());
  }

  run_until(*bus, limit > kUntilHint && printed == 0 ? limit - kUntilHint : limit, done);
  return done() || (wanted == 0 && printed > 0) ? process::kDone : process::kNegative;
}

}  // namespace

void add_topic_echo(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<EchoOptions>();
  Verb(parent, cli, "echo", "print the samples of a topic; exit code 1 when none came")
      .argument("topic", options->topic, "name, e.g. plan")
      .flag("--once", options->once, "stop after the first")
      .option("--count", options->count, 0, 1'000'000'000, "stop after so many; 0: never")
      .option("--key", options->key, "only this instance, e.g. agv-1; several key fields with '/': hall/3/4")
      .flag("--full", options->full, "do not shorten long lists")
      .option("--timeout", options->timeout_s, 0.0, 1e6, "give up after so many seconds; 0: never")
      .runs([&cli, options] { return echo(cli, *options); });
}

}  // namespace aisle::cli
