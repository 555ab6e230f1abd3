#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace aisle::e2e {

/// What one run of aisle-demo left.
struct DemoRun {
  int code{-1};              // -1: it did not end in time
  std::string output;        // for a person, when something is wrong
  nlohmann::json report;     // report.json; null when there is none
  nlohmann::json processes;  // processes.json; null when there is none
};

/// Runs aisle-demo and waits for its end. The report stays in build/e2e/<name>.
DemoRun run_demo(const std::string& name, const std::vector<std::string>& arguments, double limit_s);

/// Whether the reference data that such scenarios name is on this machine (AISLE_DATA, or ../shared/data).
bool has_reference_data();

}  // namespace aisle::e2e
