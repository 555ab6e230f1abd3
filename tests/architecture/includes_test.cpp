// Who may include whom. The DDS headers lie in the system's path, so a slip compiles silently: this says no.
//   geometry grid kinematics time config <- fleet <- core <- service <- main;  Fast DDS only in common/bus/dds
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/places.hpp"

namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

struct Source {
  std::string file;  // from the top, e.g. "common/grid/clearance.cpp"
  Strings includes;  // as written between quotes or angle brackets
  Strings code;      // lines without // comments
};

Source read_source(const fs::path& path) {
  static const std::regex include(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  Source source{fs::relative(path, aisle::test_support::source_folder()).generic_string(), {}, {}};
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, include)) source.includes.push_back(match[1]);
    source.code.push_back(line.substr(0, line.find("//")));
  }
  return source;
}

const std::vector<Source>& all_sources() {
  static const std::vector<Source> sources = [] {
    std::vector<Source> found;
    for (const char* room : {"common", "services", "tools", "python"}) {
      for (const auto& entry : fs::recursive_directory_iterator(aisle::test_support::source_folder() / room)) {
        const std::string ending = entry.path().extension().string();
        if (entry.is_regular_file() && (ending == ".hpp" || ending == ".cpp"))
          found.push_back(read_source(entry.path()));
      }
    }
    return found;
  }();
  return sources;
}

bool begins_with(const std::string& text, const std::string& head) { return text.rfind(head, 0) == 0; }
bool begins_with_any(const std::string& text, const Strings& heads) {
  return std::any_of(heads.begin(), heads.end(), [&](const std::string& head) { return begins_with(text, head); });
}

/// "services/map/core/" for a file of that core, "tools/referee/core/" likewise; empty outside a core.
std::string core_of(const std::string& file) {
  static const std::regex core(R"(^((services|tools)/[^/]+/core/))");
  std::smatch match;
  return std::regex_search(file, match, core) ? match[1].str() : std::string{};
}

/// Values in, values out: no DDS, no clock, no thread, no log.
bool is_pure(const std::string& file) {
  return !core_of(file).empty() || begins_with_any(file, {"common/geometry/", "common/grid/", "common/kinematics/",
                                                          "common/time/", "common/fleet/"});
}

TEST(Architecture, FindsTheSources) { EXPECT_GT(all_sources().size(), 50U); }

TEST(Architecture, OnlyTheBusIncludesFastDds) {
  for (const Source& source : all_sources()) {
    for (const std::string& include : source.includes) {
      if (!begins_with_any(include, {"fastdds", "fastrtps", "fastcdr"})) continue;
      EXPECT_TRUE(begins_with(source.file, "common/bus/dds/")) << source.file << " includes " << include;
    }
  }
}

/// The bindings are thin: nothing else knows of Python, and they hold nothing that others need.
TEST(Architecture, OnlyTheBindingsIncludePythonAndNobodyIncludesThem) {
  for (const Source& source : all_sources()) {
    if (begins_with(source.file, "python/")) continue;
    for (const std::string& include : source.includes)
      EXPECT_FALSE(begins_with_any(include, {"pybind11", "Python.h", "python/"}))
          << source.file << " includes " << include;
  }
}

/// Only the room that turns samples into values, and the one that carries them, know the wire's types.
TEST(Architecture, OnlyBusAndWireIncludeTheIdl) {
  for (const Source& source : all_sources()) {
    if (begins_with_any(source.file, {"common/bus/", "common/wire/"})) continue;
    for (const std::string& include : source.includes)
      EXPECT_FALSE(begins_with(include, "idl/")) << source.file << " includes " << include;
  }
}

/// Names of the structs of idl/, and the beginnings of its enumerators, e.g. "NavigationStatus" and "PHASE".
struct WireNames {
  std::set<std::string> structs;
  std::set<std::string> enumerators;
};

WireNames names_of_the_idl() {
  const std::regex struct_name(R"(\bstruct\s+(\w+))");
  const std::regex enum_body(R"(\benum\s+\w+\s*\{([^}]*)\})");
  const std::regex word(R"(\w+)");
  WireNames names;
  for (const auto& entry : fs::directory_iterator(aisle::test_support::source_folder() / "idl")) {
    if (entry.path().extension() != ".idl") continue;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    using Each = std::sregex_iterator;
    for (Each it(text.begin(), text.end(), struct_name); it != Each(); ++it) names.structs.insert((*it)[1]);
    for (Each it(text.begin(), text.end(), enum_body); it != Each(); ++it) {
      const std::string body = (*it)[1];
      for (Each each(body.begin(), body.end(), word); each != Each(); ++each) names.enumerators.insert(each->str());
    }
  }
  return names;
}

/// What comes over the wire is checked at the decoder: a service, tool or command line that names a type or an
/// enumerator of the wire reads a sample past it.
TEST(Architecture, NobodyReadsARawSample) {
  const WireNames names = names_of_the_idl();
  ASSERT_GT(names.structs.size(), 15U);
  ASSERT_GT(names.enumerators.size(), 50U);
  const std::regex qualified(R"(\baisle::(\w+))");
  const std::regex enumerator(R"(\b[A-Z]+_[A-Z_]+\b)");
  using Each = std::sregex_iterator;
  for (const Source& source : all_sources()) {
    if (begins_with(source.file, "common/")) continue;
    for (const std::string& line : source.code) {
      const std::string code = std::regex_replace(line, std::regex(R"("[^"]*")"), "");
      for (Each it(code.begin(), code.end(), qualified); it != Each(); ++it)
        EXPECT_EQ(names.structs.count((*it)[1]), 0U) << source.file << ": " << line;
      for (Each it(code.begin(), code.end(), enumerator); it != Each(); ++it)
        EXPECT_EQ(names.enumerators.count(it->str()), 0U) << source.file << ": " << line;
    }
  }
}

/// Each is defined once; topics, which carry the names of their values, are not meant.
TEST(Architecture, TheFleetsValuesHaveOneDefinition) {
  const std::regex definition(
      R"(\b(?:struct|class|enum)\s+(?:class\s+)?(Vehicle|Plan|Grant|Goal|Track|Claim)\b(?!\s*;))");
  std::map<std::string, Strings> homes;
  for (const Source& source : all_sources()) {
    if (begins_with(source.file, "common/bus/topics")) continue;
    for (const std::string& line : source.code) {
      std::smatch match;
      if (std::regex_search(line, match, definition)) homes[match[1]].push_back(source.file);
    }
  }
  for (const char* name : {"Vehicle", "Plan", "Grant", "Goal", "Track"}) {
    ASSERT_EQ(homes[name].size(), 1U) << name << " is defined in " << testing::PrintToString(homes[name]);
    EXPECT_TRUE(begins_with(homes[name][0], "common/fleet/")) << name << " is defined in " << homes[name][0];
  }
  EXPECT_LE(homes["Claim"].size(), 1U) << "Claim is defined in " << testing::PrintToString(homes["Claim"]);
}

/// The bus holds the clocks, so that a whole site can run in virtual time. (Logging and a process's own CPU time are
/// common/process's.)
TEST(Architecture, ClocksAreTheBuss) {
  const Strings bound{"services/", "common/", "tools/referee/"};
  const Strings homes{"common/bus/", "common/time/", "common/process/"};
  const std::regex clock(
      R"(\b(steady_clock|system_clock|high_resolution_clock|clock_gettime|gettimeofday|monotonic_now)\b|\bprocess::wall_clock_ns\b)");
  for (const Source& source : all_sources()) {
    if (!begins_with_any(source.file, bound) || begins_with_any(source.file, homes)) continue;
    for (const std::string& include : source.includes)
      EXPECT_NE(include, "common/process/clock.hpp") << source.file << " includes " << include;
    for (const std::string& line : source.code)
      EXPECT_FALSE(std::regex_search(line, clock)) << source.file << ": " << line;
  }
}

/// Services hear values from their shell's inboxes: what kind a sample is, and whether it can be used, is decided
/// there.
TEST(Architecture, ServicesReadNoRawSample) {
  const std::regex raw(R"(\bSampleKind\b|\bSampleInfo\b|\bbus_?(\(\))?\.on<|\bOriginStamper\b)");
  for (const Source& source : all_sources()) {
    if (!begins_with(source.file, "services/")) continue;
    for (const std::string& line : source.code)
      EXPECT_FALSE(std::regex_search(line, raw)) << source.file << ": " << line;
    for (const std::string& include : source.includes)
      EXPECT_FALSE(begins_with(include, "idl/")) << source.file << " includes " << include;
  }
}

TEST(Architecture, CoresKnowNoDdsClockThreadOrLog) {
  const Strings refused{"idl/",   "common/bus/", "common/wire/", "common/service/",    "common/process/", "spdlog",
                        "thread", "mutex",       "shared_mutex", "condition_variable", "future"};
  const std::regex clock_or_chance(
      R"(::now\s*\(|\brandom_device\b|\bstd::this_thread\b|\btime\s*\(\s*(nullptr|NULL|0)\s*\)|\bgettimeofday\b|\bclock_gettime\b|\bstd::c(out|err)\b)");
  for (const Source& source : all_sources()) {
    if (!is_pure(source.file)) continue;
    for (const std::string& include : source.includes) {
      const bool is_refused = std::any_of(refused.begin(), refused.end(), [&](const std::string& what) {
        return what.back() == '/' || what == "spdlog" ? begins_with(include, what) : include == what;
      });
      EXPECT_FALSE(is_refused) << source.file << " includes " << include;
    }
    for (const std::string& line : source.code)
      EXPECT_FALSE(std::regex_search(line, clock_or_chance)) << source.file << ": " << line;
  }
}

/// What a file may include of ours, beside its own folder.
Strings allowed_rooms(const std::string& file) {
  if (begins_with(file, "common/geometry/") || begins_with(file, "common/time/")) return {};
  if (begins_with(file, "common/kinematics/")) return {"common/geometry/", "common/time/"};
  if (begins_with(file, "common/fleet/")) return {"common/geometry/", "common/kinematics/", "common/time/"};
  if (begins_with(file, "common/grid/")) return {"common/geometry/", "common/time/", "common/config/"};
  if (begins_with(file, "common/config/")) return {};
  if (begins_with(file, "common/process/")) return {"common/time/", "common/config/"};
  if (begins_with(file, "common/scenario/"))
    return {"common/geometry/", "common/grid/",  "common/kinematics/",
            "common/time/",     "common/fleet/", "common/config/"};
  if (begins_with(file, "common/bus/")) return {"common/config/", "common/time/"};
  if (begins_with(file, "common/wire/"))
    return {"common/geometry/", "common/grid/", "common/kinematics/", "common/time/", "common/fleet/"};
  if (begins_with(file, "common/")) return {"common/"};
  const Strings for_cores{"common/geometry/", "common/grid/",   "common/kinematics/", "common/fleet/",
                          "common/time/",     "common/config/", "common/scenario/"};
  // Pictures of maps, their zones and curves know nothing of vehicles, so that the referee may use them and share no
  // planner.
  if (begins_with(file, "tools/draw/")) return {"common/geometry/", "common/grid/", "common/fleet/zone.hpp"};
  if (begins_with(file, "tools/referee/core/")) return for_cores;
  if (begins_with(file, "tools/referee/report/")) return {"common/", "tools/draw/"};
  if (begins_with(file, "tools/referee/")) return {"common/"};
  if (!core_of(file).empty()) return for_cores;
  // The simulated site builds the services themselves.
  if (begins_with(file, "tools/sim/")) return {"common/", "services/", "tools/referee/"};
  // The laboratory and `aisle drive` run simulations and draw their runs as the referee draws real ones.
  Strings for_runs{"common/", "services/", "tools/sim/", "tools/draw/", "tools/referee/core/", "tools/referee/report/"};
  if (begins_with(file, "tools/lab/")) return for_runs;
  if (begins_with_any(file, {"tools/cli/", "python/"})) {
    for_runs.push_back("tools/lab/");
    return for_runs;
  }
  if (begins_with(file, "tools/")) return {"common/", "services/"};
  return {"common/"};  // a service; its own folder comes with it
}

TEST(Architecture, IncludesPointOneWay) {
  for (const Source& source : all_sources()) {
    Strings allowed = allowed_rooms(source.file);
    const std::size_t second = source.file.find('/', source.file.find('/') + 1);
    const std::string core = core_of(source.file);
    allowed.push_back(core.empty() ? source.file.substr(0, second + 1) : core);
    for (const std::string& include : source.includes) {
      if (!begins_with_any(include, {"common/", "services/", "tools/", "tests/"})) continue;
      EXPECT_TRUE(begins_with_any(include, allowed)) << source.file << " includes " << include;
      const bool is_program =
          begins_with(source.file, "tools/") && !begins_with(source.file, "tools/sim/") && core.empty();
      if (is_program && begins_with(include, "services/")) {
        EXPECT_FALSE(core_of(include).empty()) << source.file << " includes " << include;
      }
    }
  }
}

}  // namespace
