#include "common/process/own_usage.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace aisle::process {
namespace {

time::Stamp duration_of(const timeval& t) {
  return std::chrono::seconds(t.tv_sec) + std::chrono::microseconds(t.tv_usec);
}

}  // namespace

double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double total_pages = 0.0;
  double resident_pages = 0.0;
  if (!(statm >> total_pages >> resident_pages)) return 0.0;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

time::Stamp cpu_time() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return {};
  return duration_of(usage.ru_utime) + duration_of(usage.ru_stime);
}

/// 100 used / elapsed, once there is an earlier call to compare with.
double CpuMeter::percent_since_last(time::Stamp now, time::Stamp cpu) {
  const double elapsed_s = time::seconds(now - last_now_);
  const double used_s = time::seconds(cpu - last_cpu_);
  const bool has_interval = started_ && elapsed_s > 0.0;

  started_ = true;
  last_now_ = now;
  last_cpu_ = cpu;

  return has_interval ? 100.0 * used_s / elapsed_s : 0.0;
}

}  // namespace aisle::process
