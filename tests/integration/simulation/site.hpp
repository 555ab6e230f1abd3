#pragma once
// A site of its own for a test: other runs of the same test on this machine are in other partitions.
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/integration/bus/two_buses.hpp"

namespace aisle::simulation_test {

using bus_test::run_until;

inline bus::Settings site(int domain, const std::string& name) {
  bus::Settings settings = bus_test::loopback(domain, name);
  settings.partition = "simulation-test-" + std::to_string(getpid());
  return settings;
}

/// A folder that is gone after the test.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("aisle-" + name + "-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace aisle::simulation_test
