#pragma once

#include <string>
#include <utility>

namespace aisle::demo {

/// Reserves a DDS domain of this host for one run: a locked file in the temporary folder, which the
/// kernel unlocks when the process ends.
class DomainLock {
 public:
  /// The domain `wanted`, 0 to 230. @throws config::BadEnvironment when another run has it
  static DomainLock take(int wanted);

  /// A free one within 100 to 200; the first try follows from `process_id`. @throws
  /// config::BadEnvironment when all are taken
  static DomainLock take_any(int process_id);

  DomainLock(DomainLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)), domain_(other.domain_) {}
  DomainLock& operator=(DomainLock&&) = delete;
  ~DomainLock();
  int domain() const { return domain_; }

 private:
  DomainLock(int descriptor, int domain) : descriptor_(descriptor), domain_(domain) {}

  /// See domain_lock.cpp.
  static int try_lock(int domain);

  int descriptor_;
  int domain_;
};

}  // namespace aisle::demo
