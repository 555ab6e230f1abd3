#include "tools/demo/progress.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace aisle::demo {

Progress::Progress(bool is_terminal) : is_terminal_(is_terminal) {}

void Progress::clear_line() {
  if (line_is_open_) fmt::print("\r\033[K");
  line_is_open_ = false;
}

void Progress::say(const std::string& text) {
  clear_line();
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

void Progress::referee_line(const std::string& line) {
  if (line.empty() || line.front() != '{') {
    say(line);
    return;
  }

  const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
  if (json.is_discarded()) return;

  const std::string text =
      fmt::format("{:6.0f} s  {} of {} goals reached, {} given, {} vehicles, {} contacts", json.value("t_s", 0.0),
                  json.value("goals_reached", 0), json.value("goals_expected", 0), json.value("goals_assigned", 0),
                  json.value("vehicles", 0), json.value("contacts", 0));
  if (is_terminal_) {
    clear_line();
    fmt::print("{}", text);
    line_is_open_ = true;
  } else if (count_++ % kEvery == 0) {
    fmt::print("{}\n", text);
  }

  std::fflush(stdout);
}

}  // namespace aisle::demo
