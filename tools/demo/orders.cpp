#include "tools/demo/orders.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"

namespace aisle::demo {
namespace {

constexpr double kLongest_s = 86400.0;

/// 0 to a day. `form`: how the whole text should look, for the error.
double seconds_of(std::string_view digits, const std::string& text, const char* form) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);

  if (error != std::errc() || end != digits.data() + digits.size() || !(value >= 0.0 && value <= kLongest_s)) {
    throw config::BadInput(fmt::format("'{}' in '{}' is no number of seconds from 0 to {:.0f}; the form is {}", digits,
                                       text, kLongest_s, form));
  }

  return value;
}

}  // namespace

/// Restarts after a second when nothing is said.
KillOrder parse_kill(const std::string& text) {
  constexpr const char* kForm = "SERVICE@SECONDS[:RESTART_AFTER_S]";
  const std::size_t at = text.find('@');
  if (at == std::string::npos || at == 0) throw config::BadInput(fmt::format("--kill {}: the form is {}", text, kForm));

  const std::size_t colon = text.find(':', at);
  const std::string_view view(text);
  KillOrder order{text.substr(0, at), 0.0, 1.0};

  order.at_s = seconds_of(view.substr(at + 1, colon == std::string::npos ? colon : colon - at - 1), text, kForm);
  if (colon != std::string::npos) order.restart_after_s = seconds_of(view.substr(colon + 1), text, kForm);

  return order;
}

DelayOrder parse_delay(const std::string& text) {
  constexpr const char* kForm = "SERVICE@SECONDS";
  const std::size_t at = text.find('@');
  if (at == std::string::npos || at == 0)
    throw config::BadInput(fmt::format("--delay {}: the form is {}", text, kForm));
  return {text.substr(0, at), seconds_of(std::string_view(text).substr(at + 1), text, kForm)};
}

bool means(const std::string& service, const std::string& instance) {
  return instance == service || instance.compare(0, service.size() + 1, service + "-") == 0;
}

void require_known(const std::string& service, const std::vector<std::string>& instances) {
  if (std::any_of(instances.begin(), instances.end(), [&](const std::string& i) { return means(service, i); })) return;
  const std::string near = config::nearest_name(service, instances);
  throw config::BadInput(fmt::format("no process '{}' in this run{}; there are {}", service,
                                     near.empty() ? "" : ", did you mean '" + near + "'", fmt::join(instances, ", ")));
}

}  // namespace aisle::demo
