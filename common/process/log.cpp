#include "common/process/log.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"

namespace aisle::process {
namespace {

/// The message as one field: spdlog's own %v would let a quote or a line end out.
class EscapedText final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string text = escape_for_log(std::string(message.payload.data(), message.payload.size()));
    out.append(text.data(), text.data() + text.size());
  }

  std::unique_ptr<custom_flag_formatter> clone() const override { return spdlog::details::make_unique<EscapedText>(); }
};

}  // namespace

const std::vector<std::string>& log_levels() {
  static const std::vector<std::string> levels{"debug", "info", "warning", "error", "off"};
  return levels;
}

/// Quotes and backslashes get a backslash, control characters become \xNN.
std::string escape_for_log(const std::string& text) {
  std::string out;
  out.reserve(text.size());

  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (byte < 0x20 || byte == 0x7f) {
      char hex[8];
      std::snprintf(hex, sizeof hex, "\\x%02x", static_cast<unsigned>(byte));
      out += hex;
    } else {
      out += c;
    }
  }

  return out;
}

void start_logging(const std::string& instance_id, const std::string& level) {
  const std::vector<std::string>& levels = log_levels();
  if (std::find(levels.begin(), levels.end(), level) == levels.end()) {
    const std::string nearest = config::nearest_name(level, levels);
    throw config::BadInput("--log-level: '" + level + "' is none of debug, info, warning, error, off" +
                           (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
  }

  auto formatter = std::make_unique<spdlog::pattern_formatter>(spdlog::pattern_time_type::utc);
  formatter->add_flag<EscapedText>('*').set_pattern("time=%Y-%m-%dT%H:%M:%S.%eZ level=%l instance=%n text=\"%*\"");

  auto sink = std::make_shared<spdlog::sinks::stderr_sink_st>();
  sink->set_formatter(std::move(formatter));

  auto logger = std::make_shared<spdlog::logger>(escape_for_log(instance_id), std::move(sink));
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(std::move(logger));
}

RateLimit::RateLimit(time::Stamp period, std::size_t max_kinds) : period_(period), max_kinds_(max_kinds) {}

/// One entry a kind: when its next line may pass, and how many did not since the last one.
RateLimit::Pass RateLimit::ask(const std::string& kind, time::Stamp now) {
  const bool is_full = entries_.size() >= max_kinds_ && entries_.find(kind) == entries_.end();
  const auto [position, is_first] = entries_.try_emplace(is_full ? std::string("(other)") : kind);
  Entry& entry = position->second;

  if (!is_first && now < entry.next) {
    ++entry.kept_back;
    return {false, 0};
  }

  entry.next = now + period_;
  return {true, std::exchange(entry.kept_back, 0)};
}

}  // namespace aisle::process
