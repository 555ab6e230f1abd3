#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/time/stamp.hpp"

namespace aisle::process {

/// Names for --log-level.
const std::vector<std::string>& log_levels();

/// From now on spdlog::info(...) and its siblings write one line each to stderr, key=value throughout:
///
///     time=2026-11-03T07:15:02.113Z level=info instance=map-1 text="revision 3, 12 cells changed"
///
/// A clone of the default logger under another name writes lines of that instance. The text cannot
/// break the line: quotes, backslashes and control characters are escaped. @throws config::BadInput for
/// a level that is not in log_levels()
void start_logging(const std::string& instance_id, const std::string& level);

/// `text` as it stands between quotes in such a line.
std::string escape_for_log(const std::string& text);

/// Lets the first line of each kind through, then at most one a period; the next line that passes says
/// how many were held back.
class RateLimit {
 public:
  /// At most `max_kinds` kinds are remembered; when full, new kinds share one entry, so that memory
  /// stays bounded however many kinds come.
  explicit RateLimit(time::Stamp period, std::size_t max_kinds = 256);

  /// May this line be written, and how many were not?
  struct Pass {
    bool allowed{false};
    std::uint64_t kept_back{0};  // of this kind since the line before
  };

  Pass ask(const std::string& kind, time::Stamp now);

 private:
  struct Entry {
    time::Stamp next{};
    std::uint64_t kept_back{0};
  };

  time::Stamp period_;
  std::size_t max_kinds_;
  std::unordered_map<std::string, Entry> entries_;
};

}  // namespace aisle::process
