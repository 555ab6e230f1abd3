#pragma once

#include "common/bus/settings.hpp"

namespace CLI {
class App;
}

namespace aisle::service {

/// Adds --domain, --partition, --interface, --peer, --discovery-server and --shared-memory, with their environment
/// variables (AISLE_DOMAIN, AISLE_PARTITION, AISLE_INTERFACES, AISLE_PEERS, AISLE_DISCOVERY_SERVER,
/// AISLE_SHARED_MEMORY; lists with commas).
void add_site_options(CLI::App& app, bus::Settings& settings);

/// Names the keys of `security` in the `site` section of a config file: paths of PEM and S/MIME files.
struct SecurityConfig {
  bus::Security& security;

  template <class Reader>
  void describe(Reader& r) {
    r.field("identity_ca", security.identity_ca)
        .field("certificate", security.certificate)
        .field("private_key", security.private_key)
        .field("permissions_ca", security.permissions_ca)
        .field("governance", security.governance)
        .field("permissions", security.permissions)
        .require({"identity_ca", "certificate", "private_key", "permissions_ca", "governance", "permissions"});
  }
};

/// Names the keys of the `site` section of a config file.
struct SiteConfig {
  bus::Settings& settings;

  template <class Reader>
  void describe(Reader& r) {
    SecurityConfig security{settings.security};
    r.field("domain", settings.domain, 0, 230)
        .field("partition", settings.partition)
        .field("interfaces", settings.interfaces)
        .field("peers", settings.peers)
        .field("discovery_server", settings.discovery_server)
        .field("shared_memory", settings.shared_memory)
        .field("max_message_bytes", settings.max_message_bytes, 0, 65500)
        .section("security", security);
  }
};

}  // namespace aisle::service
