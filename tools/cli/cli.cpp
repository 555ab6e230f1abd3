#include "tools/cli/cli.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "common/bus/dds/dds_bus.hpp"
#include "common/process/clock.hpp"
#include "common/process/signals.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

/// The parser's range check alone lets NaN pass. @returns an error text, empty for a number
std::string is_number(const std::string& text) {
  return std::isnan(std::strtod(text.c_str(), nullptr)) ? text + " is not a number" : std::string{};
}

}  // namespace

Verb::Verb(CLI::App& parent, Cli& cli, const std::string& name, const std::string& purpose)
    : app_(parent.add_subcommand(name, purpose)), cli_(cli) {
  app_->fallthrough();
  app_->add_flag("--json", cli.json, "write JSON, one line each");
  app_->footer("Flags of the site (--domain, --partition, --interface, --peer, ...): see aisle --help.");
}

Verb& Verb::argument(const std::string& name, std::string& value, const std::string& help) {
  app_->add_option(name, value, help)->required();
  return *this;
}

Verb& Verb::optional_argument(const std::string& name, std::string& value, const std::string& help) {
  app_->add_option(name, value, help);
  return *this;
}

Verb& Verb::flag(const std::string& name, bool& value, const std::string& help) {
  app_->add_flag(name, value, help);
  return *this;
}

Verb& Verb::option(const std::string& name, std::string& value, const std::string& help) {
  app_->add_option(name, value, help);
  return *this;
}

Verb& Verb::option(const std::string& name, double& value, double low, double high, const std::string& help) {
  app_->add_option(name, value, help)->check(is_number)->check(CLI::Range(low, high))->capture_default_str();
  return *this;
}

Verb& Verb::option(const std::string& name, int& value, int low, int high, const std::string& help) {
  app_->add_option(name, value, help)->check(CLI::Range(low, high))->capture_default_str();
  return *this;
}

Verb& Verb::list(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  app_->add_option(name, values, help);
  return *this;
}

void Verb::runs(std::function<int()> action) {
  // A verb that has verbs below it is asked after them.
  app_->callback([&cli = cli_, app = app_, action = std::move(action)] {
    if (app->get_subcommands().empty()) cli.action = action;
  });
}

/// Only what keeps samples from passing is worth a warning here.
std::unique_ptr<bus::Bus> join(const Cli& cli, const std::string& name) {
  bus::Settings settings = cli.settings;
  settings.participant_name = name;
  settings.super_client = !settings.discovery_server.empty();

  auto bus = std::make_unique<bus::DdsBus>(settings);

  bus->on_incident([](const bus::Incident& incident) {
    const bool is_mismatch =
        incident.kind == bus::Incident::Kind::kIncompatibleQos || incident.kind == bus::Incident::Kind::kTypeMismatch;
    if (is_mismatch) std::fprintf(stderr, "warning: %s\n", printable(incident.text).c_str());
  });

  return bus;
}

/// In pieces of 100 ms, so that a signal ends it soon.
bool run_until(bus::Bus& bus, Seconds limit, const std::function<bool()>& done) {
  using std::chrono::nanoseconds;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration_cast<nanoseconds>(limit);

  while (!done()) {
    const nanoseconds left = std::chrono::duration_cast<nanoseconds>(end - std::chrono::steady_clock::now());
    if (left <= nanoseconds::zero() || is_interrupted()) return false;
    bus.run_once(std::min<nanoseconds>(left, std::chrono::milliseconds(100)));
  }

  return true;
}

bool is_interrupted() { return process::stop_on_signals().load(); }

/// Everything that decides which other processes can be seen.
std::string place_of(const bus::Settings& settings) {
  std::string text = "domain " + std::to_string(settings.domain);
  if (!settings.partition.empty()) text += ", partition '" + settings.partition + "'";
  for (const std::string& address : settings.interfaces) text += ", interface " + address;
  if (settings.interfaces.empty()) text += ", all interfaces";
  for (const std::string& peer : settings.peers) text += ", peer " + peer;
  if (!settings.discovery_server.empty()) text += ", discovery server " + settings.discovery_server;

  return text;
}

std::string unique_id(const std::string& prefix) {
  return prefix + "-" + std::to_string(process::wall_clock_ns() / 1000);
}

std::vector<std::string> protect_negative_numbers(int argc, const char* const* argv) {
  std::vector<std::string> arguments(argv, argv + argc);
  for (std::string& argument : arguments) {
    const bool is_number = argument.size() > 1 && argument[0] == '-' &&
                           (std::isdigit(static_cast<unsigned char>(argument[1])) || argument[1] == '.');
    if (is_number) argument.insert(argument.begin(), ' ');
  }

  return arguments;
}

}  // namespace aisle::cli
