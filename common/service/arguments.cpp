#include "common/service/arguments.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "common/bus/settings.hpp"
#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"
#include "common/service/site_options.hpp"

namespace aisle::service {
namespace {

/// Of the program, and of the verb that was chosen.
void add_flag_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }

  for (const CLI::App* verb : app.get_subcommands()) add_flag_names(*verb, names);
}

/// Of the innermost verb that was chosen.
void add_verb_names(const CLI::App& app, std::vector<std::string>& names) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  if (!chosen.empty()) return add_verb_names(*chosen.front(), names);
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
}

/// Names the nearest flag or verb that exists here.
std::string unknown_argument(const CLI::App& app, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  const bool is_flag = name.rfind('-', 0) == 0;
  std::vector<std::string> known;

  if (is_flag) {
    add_flag_names(app, known);
  } else {
    add_verb_names(app, known);
  }

  const std::string nearest = config::nearest_name(name, known);
  if (nearest == name) return "'" + name + "' is not expected here; see --help";  // e.g. after a lone --

  return (is_flag ? "unknown flag '" : "unexpected argument '") + name + "'" +
         (nearest.empty() ? "; see --help" : "; did you mean '" + nearest + "'?");
}

}  // namespace

/// --help and --version come as a parse error with exit code 0.
std::optional<int> parse_arguments(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error, std::cout, std::cerr);

    // A mistyped verb is reported as one that is missing: name what was typed instead.
    const std::vector<std::string> extras = app.remaining(true);
    if (!extras.empty()) throw config::BadInput(unknown_argument(app, extras.front()));

    throw config::BadInput(std::string(error.what()) + "; see --help");
  }
}

/// Flag and environment variable for each setting of the site; lists may be written with commas.
void add_site_options(CLI::App& app, bus::Settings& settings) {
  const std::string group = "Site";
  app.add_option("--domain", settings.domain, "DDS domain of the site, 0 to 230")
      ->envname("AISLE_DOMAIN")
      ->check(CLI::Range(0, 230))
      ->group(group);
  app.add_option("--partition", settings.partition, "DDS partition of the site")
      ->envname("AISLE_PARTITION")
      ->group(group);
  app.add_option("--interface", settings.interfaces,
                 "IPv4 address to bind to, more than once or with commas; all when not given")
      ->envname("AISLE_INTERFACES")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::ValidIPV4)
      ->group(group);
  app.add_option("--peer", settings.peers,
                 "address of another host, where multicast is missing; more than once or with commas")
      ->envname("AISLE_PEERS")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("--discovery-server", settings.discovery_server,
                 "ADDRESS:PORT of a discovery server, instead of multicast")
      ->envname("AISLE_DISCOVERY_SERVER")
      ->group(group);

  app.add_flag("--shared-memory", settings.shared_memory, "use shared memory between processes of this host too")
      ->envname("AISLE_SHARED_MEMORY")
      ->group(group);
}

}  // namespace aisle::service
