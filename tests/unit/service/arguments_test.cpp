#include "common/service/arguments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <string>
#include <vector>

#include "common/bus/settings.hpp"
#include "common/config/reader.hpp"
#include "common/config/yaml_reader.hpp"
#include "common/service/site_options.hpp"

namespace aisle::service {
namespace {

using ::testing::ElementsAre;

class Arguments : public ::testing::Test {
 protected:
  Arguments() {
    add_site_options(app_, settings_);
    CLI::App* topic = app_.add_subcommand("topic");
    topic->add_subcommand("list");
    topic->add_subcommand("echo")->add_option("--count", count_);
  }
  std::string parse(const std::vector<const char*>& arguments) {
    std::vector<const char*> argv{"aisle"};
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    try {
      parse_arguments(app_, static_cast<int>(argv.size()), argv.data());
      return "";
    } catch (const config::BadInput& error) {
      return error.what();
    }
  }
  CLI::App app_{"test"};
  bus::Settings settings_;
  int count_{0};
};

TEST_F(Arguments, FillTheSettingsOfTheSite) {
  EXPECT_EQ(
      parse({"--domain", "12", "--partition=hall-2", "--interface", "127.0.0.1,10.0.0.4", "--interface", "10.0.0.5",
             "--peer", "a", "--peer", "b", "--discovery-server", "10.0.0.1:11811", "--shared-memory"}),
      "");
  EXPECT_EQ(settings_.domain, 12);
  EXPECT_EQ(settings_.partition, "hall-2");
  EXPECT_THAT(settings_.interfaces, ElementsAre("127.0.0.1", "10.0.0.4", "10.0.0.5"));
  EXPECT_THAT(settings_.peers, ElementsAre("a", "b"));
  EXPECT_EQ(settings_.discovery_server, "10.0.0.1:11811");
  EXPECT_TRUE(settings_.shared_memory);
}

TEST_F(Arguments, WinOverTheEnvironment) {
  setenv("AISLE_DOMAIN", "33", 1);
  setenv("AISLE_PEERS", "10.0.0.1,10.0.0.2", 1);
  EXPECT_EQ(parse({"--peer", "10.0.0.9"}), "");
  unsetenv("AISLE_DOMAIN");
  unsetenv("AISLE_PEERS");
  EXPECT_EQ(settings_.domain, 33);
  EXPECT_THAT(settings_.peers, ElementsAre("10.0.0.9"));
}

TEST_F(Arguments, OfBadValuesAreNamed) {
  // The words between are the parser's own, and differ between its releases.
  EXPECT_THAT(parse({"--domain", "300"}),
              ::testing::MatchesRegex("--domain: Value 300 not in range .*230.*; see --help"));
  EXPECT_THAT(parse({"--domain", "two"}),
              ::testing::MatchesRegex("--domain: Value two not in range .*230.*; see --help"));
  EXPECT_THAT(parse({"--interface", "10.0.0.400"}), ::testing::HasSubstr("--interface"));
}

TEST_F(Arguments, ThatAreUnknownGetTheNearestName) {
  EXPECT_EQ(parse({"--domian", "3"}), "unknown flag '--domian'; did you mean '--domain'?");
  EXPECT_EQ(parse({"--domian=3"}), "unknown flag '--domian'; did you mean '--domain'?");
  EXPECT_EQ(parse({"topc", "list"}), "unexpected argument 'topc'; did you mean 'topic'?");
  EXPECT_EQ(parse({"topic", "ecko"}), "unexpected argument 'ecko'; did you mean 'echo'?");
  EXPECT_EQ(parse({"topic", "echo", "--cuont", "3"}), "unknown flag '--cuont'; did you mean '--count'?");
  EXPECT_EQ(parse({"--qqqqqqqqq"}), "unknown flag '--qqqqqqqqq'; see --help");
}

TEST(SiteConfig, ReadsTheSiteSectionAndWantsSecurityWhole) {
  bus::Settings settings;
  SiteConfig site{settings};
  config::read_yaml_text("domain: 5\npeers: [10.0.0.1]\n", "site.yaml", site);
  EXPECT_EQ(settings.domain, 5);
  EXPECT_THAT(settings.peers, ElementsAre("10.0.0.1"));
  EXPECT_THROW(config::read_yaml_text("security: {identity_ca: ca.pem}\n", "site.yaml", site), config::BadInput);
}

}  // namespace
}  // namespace aisle::service
