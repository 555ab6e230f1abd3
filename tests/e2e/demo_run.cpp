#include "tests/e2e/demo_run.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace aisle::e2e {
namespace {

namespace fs = std::filesystem;

nlohmann::json read_json(const fs::path& file) {
  std::ifstream in(file);
  return in ? nlohmann::json::parse(in, nullptr, false) : nlohmann::json();
}

}  // namespace

DemoRun run_demo(const std::string& name, const std::vector<std::string>& arguments, double limit_s) {
  const fs::path out = test_support::program_folder() / "../e2e" / name;
  fs::remove_all(out);
  std::vector<std::string> command{test_support::program("aisle-demo"), "--out", out.string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  test_support::ChildProcess demo(command);
  DemoRun run;
  run.code = demo.wait(std::chrono::milliseconds(static_cast<long>(limit_s * 1e3))).value_or(-1);
  run.output = demo.out() + demo.err();
  run.report = read_json(out / "report.json");
  run.processes = read_json(out / "processes.json");
  return run;
}

bool has_reference_data() {
  const char* set = std::getenv("AISLE_DATA");
  if (set != nullptr && *set != '\0') return fs::is_directory(set);
  return fs::is_directory(test_support::source_folder() / "../shared/data") || fs::is_directory("../shared/data");
}

}  // namespace aisle::e2e
