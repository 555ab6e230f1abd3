// aisle-map as a process: what it keeps over restarts and kills, and what it says when it cannot start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <set>

#include "common/grid/formats/map_file.hpp"
#include "services/map/core/map_store.hpp"
#include "tests/integration/map/site_fixture.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"
#include "tests/unit/map/temporary_folder.hpp"

namespace aisle::map {
namespace {

using fleet::MapEdit;
using fleet::MapEditResult;
using test_support::ChildProcess;
using ::testing::HasSubstr;
using testing::rectangle;
using testing::Site;
using Action = MapEdit::Action;
namespace fs = std::filesystem;

constexpr int kDomain = 166;  // and the next ones

class MapProcess : public ::testing::Test {
 protected:
  MapProcess() {
    std::ofstream out(map_file());
    for (int row = 0; row < 80; ++row) out << std::string(120, row % 20 == 7 ? '#' : '.') << '\n';
  }
  fs::path map_file() const { return folder_.path() / "floor.txt"; }
  fs::path journal() const { return folder_.path() / "floor.journal"; }
  std::unique_ptr<ChildProcess> start(std::vector<std::string> more, int domain) const {
    std::vector<std::string> command{test_support::program("aisle-map"), "--domain", std::to_string(domain),
                                     "--interface", "127.0.0.1"};
    command.insert(command.end(), more.begin(), more.end());
    return std::make_unique<ChildProcess>(command);
  }
  std::unique_ptr<ChildProcess> start_on_floor(int domain) const {
    return start({"--map", map_file().string(), "--cell-m", "0.25", "--journal", journal().string()}, domain);
  }
  /// The map as the journal says, made without the process.
  SiteMap replayed() const {
    SiteMap base("floor", grid::read_map_file(map_file(), {0.25, 1}));
    auto opened = std::make_unique<Journal>(journal(), "floor", base.summary().hash, Journal::Options{});
    return MapStore(std::move(base), std::move(opened), {}).map();
  }
  testing::TemporaryFolder folder_;
};

TEST_F(MapProcess, KeepsItsEditsOverARestart) {
  Site site(kDomain);
  auto process = start_on_floor(kDomain);
  const auto run = [&](const std::function<bool()>& done) { return testing::run_until({&site.bus}, done); };
  ASSERT_TRUE(run([&] { return site.map.is_complete() && site.can_send(); })) << process->err();
  EXPECT_EQ(site.map.revision(), 1U);
  EXPECT_EQ(site.map.grid().geometry(), (grid::Geometry{120, 80, 0.25, {0.0, 0.0}}));
  site.send(rectangle("one", Action::kBlock, {2.0, 2.0}, {4.0, 4.0}));
  ASSERT_TRUE(run([&] { return site.results.count("one") > 0 && site.map.revision() == 2; }));
  const auto cells = site.map.grid().cells();
  process->signal(SIGTERM);
  EXPECT_EQ(process->wait(std::chrono::seconds(5)), 0);
  EXPECT_THAT(process->err(),
              HasSubstr("map=floor cells=120x80 resolution_m=0.25 tiles=4 revision=1 zones=0 edits=0 journal=" +
                        journal().string()));

  process = start_on_floor(kDomain);
  Site fresh(kDomain, "fresh");
  const auto run_both = [&](const std::function<bool()>& done) {
    return testing::run_until({&site.bus, &fresh.bus}, done);
  };
  ASSERT_TRUE(run_both([&] { return fresh.map.is_complete() && fresh.can_send(); })) << process->err();
  EXPECT_EQ(fresh.map.revision(), 2U);
  EXPECT_EQ(fresh.map.grid().cells(), cells);
  fresh.send(rectangle("one", Action::kBlock, {2.0, 2.0}, {4.0, 4.0}));
  ASSERT_TRUE(run_both([&] { return fresh.results.count("one") > 0; }));
  EXPECT_EQ(fresh.results["one"].outcome, MapEditResult::Outcome::kAlreadyApplied);
  EXPECT_EQ(fresh.results["one"].revision, 2U);
  // A mirror from before the restart goes on with the new process.
  ASSERT_TRUE(run_both([&] { return site.can_send(); }));
  fresh.send(rectangle("two", Action::kUnblock, {2.0, 2.0}, {4.0, 4.0}));
  ASSERT_TRUE(run_both([&] { return site.map.revision() == 3 && fresh.map.revision() == 3; }))
      << site.map.revision() << " " << fresh.map.revision() << " " << fresh.results.count("two") << " "
      << process->wait(std::chrono::seconds(1)).value_or(-1) << process->err() << process->out();
  EXPECT_EQ(site.map.grid().cells(), fresh.map.grid().cells());
}

TEST_F(MapProcess, KeepsItsZonesOverARestart) {
  std::ofstream(folder_.path() / "floor.zones.yaml")
      << "zones:\n  - {id: office, kind: keep-out, rectangle: [1, 1, 3, 3]}\n";
  const int domain = kDomain + 8;
  Site site(domain);
  auto process = start_on_floor(domain);
  const auto run = [&](const std::function<bool()>& done) { return testing::run_until({&site.bus}, done); };
  ASSERT_TRUE(run([&] { return site.map.is_complete() && site.map.has_zones() && site.can_send(); })) << process->err();
  ASSERT_EQ(site.map.zones().size(), 1U);

  fleet::ZoneEdit edit{"one", "floor", fleet::ZoneEdit::Action::kAdd, site.map.zones()[0]};
  edit.zone.id = "kitchen";
  site.send(edit);
  ASSERT_TRUE(run([&] { return site.results.count("one") > 0; }));
  EXPECT_EQ(site.results["one"].outcome, MapEditResult::Outcome::kApplied);
  process->signal(SIGKILL);
  process->wait(std::chrono::seconds(5));

  process = start_on_floor(domain);
  Site fresh(domain, "fresh");
  ASSERT_TRUE(testing::run_until({&site.bus, &fresh.bus}, [&] { return fresh.map.zones().size() == 2; }))
      << process->err();
  EXPECT_EQ(fresh.map.zones()[0], edit.zone);
}

TEST_F(MapProcess, LosesNoAcknowledgedEditWhenKilledAtAnyTime) {
  Site site(kDomain + 1);
  std::mt19937 random(7);
  std::set<std::string> acknowledged;
  std::uint64_t newest = 0;
  std::map<std::string, std::uint64_t> revisions;
  int sent = 0;
  for (int life = 0; life < 4; ++life) {
    auto process = start_on_floor(kDomain + 1);
    site.results.clear();
    const int first = sent;
    const auto kill_after = static_cast<std::size_t>(5 + random() % 40);
    const auto edit = [](int i) {
      const double x = 0.25 * (i % 100);
      const double y = 0.25 * (i * 7 % 70);
      return rectangle("e" + std::to_string(i), i % 3 == 0 ? Action::kUnblock : Action::kBlock, {x, y},
                       {x + 1.0, y + 0.75});
    };
    ASSERT_TRUE(testing::run_until({&site.bus}, [&] {
      // One edit a turn, those before answered or not; then the kill comes between any two steps of the process.
      if (site.can_send() && sent < first + 200) site.send(edit(sent++));
      for (const auto& [id, result] : site.results) {
        EXPECT_NE(result.outcome, MapEditResult::Outcome::kRefused) << id << ": " << result.detail;
        acknowledged.insert(id);
        EXPECT_TRUE(revisions.emplace(id, result.revision).first->second == result.revision) << id;
      }
      EXPECT_GE(site.map.revision(), newest) << "the revision went back";
      newest = site.map.revision();
      return site.results.size() >= kill_after;
    })) << process->err();
    process->signal(SIGKILL);
    EXPECT_EQ(process->wait(std::chrono::seconds(5)), 128 + SIGKILL);
  }
  ASSERT_GT(acknowledged.size(), 20U);

  const SiteMap truth = replayed();
  EXPECT_GE(truth.revision(), newest);
  auto process = start_on_floor(kDomain + 1);
  Site fresh(kDomain + 1, "fresh");
  ASSERT_TRUE(testing::run_until({&site.bus, &fresh.bus}, [&] { return fresh.map.is_complete() && fresh.can_send(); }))
      << process->err();
  EXPECT_EQ(fresh.map.revision(), truth.revision());
  EXPECT_EQ(fresh.map.hash(), truth.summary().hash);
  EXPECT_EQ(fresh.map.grid().cells(), truth.grid().cells());
  for (const std::string& id : acknowledged) {
    const int i = std::stoi(id.substr(1));
    const double x = 0.25 * (i % 100);
    const double y = 0.25 * (i * 7 % 70);
    fresh.send(rectangle(id, i % 3 == 0 ? Action::kUnblock : Action::kBlock, {x, y}, {x + 1.0, y + 0.75}));
  }
  ASSERT_TRUE(testing::run_until({&site.bus, &fresh.bus}, [&] { return fresh.results.size() == acknowledged.size(); }));
  for (const auto& [id, result] : fresh.results) {
    EXPECT_EQ(result.outcome, MapEditResult::Outcome::kAlreadyApplied) << id;
    EXPECT_EQ(result.revision, revisions[id]) << id;
  }
}

TEST_F(MapProcess, WithoutAJournalStartsAgainWithANewerRevision) {
  Site site(kDomain + 2);
  const auto run = [&](const std::function<bool()>& done) { return testing::run_until({&site.bus}, done); };
  const auto start_plain = [&] { return start({"--map", map_file().string()}, kDomain + 2); };
  auto process = start_plain();
  ASSERT_TRUE(run([&] { return site.map.is_complete() && site.can_send(); })) << process->err();
  const auto base = site.map.grid().cells();
  site.send(rectangle("one", Action::kBlock, {2.0, 2.0}, {4.0, 4.0}));
  ASSERT_TRUE(run([&] { return site.results.count("one") > 0 && site.map.grid().cells() != base; }));
  const std::uint64_t revision = site.map.revision();
  process->signal(SIGKILL);
  process->wait(std::chrono::seconds(5));
  EXPECT_THAT(process->err(), HasSubstr("edits=0 journal=none: edits last until this process ends"));
  process = start_plain();
  ASSERT_TRUE(run([&] { return site.map.revision() > revision; })) << process->err();
  EXPECT_EQ(site.map.grid().cells(), base);
}

TEST_F(MapProcess, SaysInOneLineWhyItCannotStart) {
  const auto refusal = [&](const std::vector<std::string>& arguments, int code) {
    auto process = start(arguments, kDomain + 3);
    EXPECT_EQ(process->wait(std::chrono::seconds(10)), code) << process->err();
    return process->err() + process->out();
  };
  EXPECT_THAT(refusal({}, 2), HasSubstr("--map"));
  EXPECT_THAT(refusal({"--map", (folder_.path() / "none.yaml").string()}, 2), HasSubstr("none.yaml: no such file"));
  EXPECT_THAT(refusal({"--map", map_file().string(), "--scenario", "x.yaml"}, 2), HasSubstr("two maps"));
  EXPECT_THAT(refusal({"--map", map_file().string(), "--map-id", "a b"}, 2), HasSubstr("'a b'"));
  EXPECT_THAT(refusal({"--map", map_file().string(), "--subdivide", "99"}, 2), HasSubstr("subdivide"));
  std::ofstream(folder_.path() / "broken.yaml")
      << "image: none.pgm\nresolution: -1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n";
  EXPECT_THAT(refusal({"--map", (folder_.path() / "broken.yaml").string()}, 2), HasSubstr("resolution"));
  EXPECT_THAT(refusal({"--map", map_file().string(), "--journal", (folder_.path() / "none" / "j").string()}, 3),
              HasSubstr("journal"));
  { Journal other(journal(), "annex", 1, {}); }
  EXPECT_THAT(refusal({"--map", map_file().string(), "--journal", journal().string()}, 2), HasSubstr("annex"));
}

TEST_F(MapProcess, TakesItsConfigFile) {
  std::ofstream(folder_.path() / "map.yaml")
      << "map: " << map_file().string() << "\nmap_id: hall\ncell_m: 0.5\nsubdivide: 2\n";
  Site site(kDomain + 4);
  auto process = start({"--config", (folder_.path() / "map.yaml").string(), "--cell-m", "1.0"}, kDomain + 4);
  ASSERT_TRUE(testing::run_until({&site.bus}, [&] { return site.map.is_complete(); })) << process->err();
  EXPECT_EQ(site.map.map_id(), "hall");
  EXPECT_EQ(site.map.grid().geometry(), (grid::Geometry{240, 160, 0.5, {0.0, 0.0}})) << "the flag wins over the file";
}

}  // namespace
}  // namespace aisle::map
