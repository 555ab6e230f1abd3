#include "services/obstacle-tracker/core/scan_clock.hpp"

#include <algorithm>
#include <cstdlib>

namespace aisle::obstacle_tracker {
namespace {

using namespace std::chrono_literals;

constexpr time::Stamp kMaxAge = 1s;
constexpr time::Stamp kMaxFuture = 200ms;  // earlier than the fastest scan so far by more than this: a wrong stamp
constexpr time::Stamp kSameLine = 100ms;
constexpr time::Stamp kWindow = 10s;  // clocks drift 1 ms in it at 100 ppm
constexpr int kRefusalsBeforeNewLine = 3;

}  // namespace

std::variant<time::Stamp, DropReason> ScanClock::place(std::int64_t stamp_ns, time::Stamp arrived) {
  const time::Stamp offset = arrived - time::Stamp{stamp_ns};

  // How late it comes, against the fastest one: `late` is below 0 for one that is faster still.
  if (offset_) {
    const time::Stamp late = offset - *offset_;
    if (late > kMaxAge || late < -kMaxFuture) {
      if (!is_new_line(offset)) return late > kMaxAge ? DropReason::kTooOld : DropReason::kFuture;
      offset_.reset();
    } else if (stamp_ns <= newest_stamp_ns_) {
      return DropReason::kNotNewer;
    }
  }

  take(offset, arrived);
  newest_stamp_ns_ = stamp_ns;
  refusals_ = 0;
  return std::min(arrived, time::Stamp{stamp_ns} + *offset_);
}

bool ScanClock::is_new_line(time::Stamp offset) {
  const bool agrees = refusals_ > 0 && std::chrono::abs(offset - refused_offset_) < kSameLine;
  refusals_ = agrees ? refusals_ + 1 : 1;
  refused_offset_ = offset;

  return refusals_ >= kRefusalsBeforeNewLine;
}

void ScanClock::take(time::Stamp offset, time::Stamp arrived) {
  if (!offset_) {
    offset_ = next_offset_ = offset;
    window_began_ = arrived;
  }

  offset_ = std::min(*offset_, offset);
  next_offset_ = std::min(next_offset_, offset);

  if (arrived - window_began_ > kWindow) {
    offset_ = next_offset_;
    next_offset_ = offset;
    window_began_ = arrived;
  }
}

}  // namespace aisle::obstacle_tracker
