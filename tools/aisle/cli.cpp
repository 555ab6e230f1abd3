#include "tools/aisle/cli.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>

#include "common/process/clock.hpp"
#include "common/process/signals.hpp"
#include "tools/aisle/text.hpp"

namespace aisle::cli {

CLI::App* add_verb(CLI::App& parent, Cli& cli, const std::string& name, const std::string& purpose) {
  CLI::App* verb = parent.add_subcommand(name, purpose);
  verb->fallthrough();
  verb->add_flag("--json", cli.json, "write JSON, one line each");
  verb->footer("Flags of the site (--domain, --partition, --interface, --peer, ...): see aisle --help.");
  return verb;
}

std::unique_ptr<bus::Bus> join(const Cli& cli, const std::string& name) {
  bus::Settings settings = cli.settings;
  settings.participant_name = name;
  settings.super_client = !settings.discovery_server.empty();
  auto bus = std::make_unique<bus::Bus>(settings);
  bus->on_incident([](const bus::Incident& incident) {
    const bool is_mismatch =
        incident.kind == bus::Incident::Kind::kIncompatibleQos || incident.kind == bus::Incident::Kind::kTypeMismatch;
    if (is_mismatch) std::fprintf(stderr, "warning: %s\n", printable(incident.text).c_str());
  });
  return bus;
}

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

std::string place_of(const bus::Settings& settings) {
  std::string text = "domain " + std::to_string(settings.domain);
  if (!settings.partition.empty()) text += ", partition '" + settings.partition + "'";
  for (const std::string& address : settings.interfaces) text += ", interface " + address;
  if (settings.interfaces.empty()) text += ", all interfaces";
  for (const std::string& peer : settings.peers) text += ", peer " + peer;
  if (!settings.discovery_server.empty()) text += ", discovery server " + settings.discovery_server;
  return text;
}

std::string unique_id(const std::string& prefix) { return prefix + "-" + std::to_string(process::wall_clock_ns() / 1000); }

std::vector<std::string> protect_negative_numbers(int argc, const char* const* argv) {
  std::vector<std::string> arguments(argv, argv + argc);
  for (std::string& argument : arguments) {
    const bool is_number = argument.size() > 1 && argument[0] == '-' && (std::isdigit(static_cast<unsigned char>(argument[1])) || argument[1] == '.');
    if (is_number) argument.insert(argument.begin(), ' ');
  }
  return arguments;
}

}  // namespace aisle::cli
