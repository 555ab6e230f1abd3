#include "tools/demo/domain_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>

#include "common/config/reader.hpp"

namespace aisle::demo {
namespace {
constexpr int kFirst = 100;
constexpr int kLast = 200;
}  // namespace

/// The locked descriptor, or -1.
int DomainLock::try_lock(int domain) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("aisle-domain-{}.lock", domain);
  const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) return -1;
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;

  close(descriptor);
  return -1;
}

DomainLock DomainLock::take(int wanted) {
  const int descriptor = try_lock(wanted);
  if (descriptor < 0)
    throw config::BadEnvironment(
        fmt::format("domain {} is in use by another run on this host; choose another --domain", wanted));
  return {descriptor, wanted};
}

/// Different processes begin their search at different domains.
DomainLock DomainLock::take_any(int process_id) {
  constexpr int kCount = kLast - kFirst + 1;
  for (int i = 0; i < kCount; ++i) {
    const int domain = kFirst + (process_id + i) % kCount;
    const int descriptor = try_lock(domain);
    if (descriptor >= 0) return {descriptor, domain};
  }

  throw config::BadEnvironment(
      fmt::format("all domains from {} to {} are in use by other runs on this host", kFirst, kLast));
}

DomainLock::~DomainLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace aisle::demo
