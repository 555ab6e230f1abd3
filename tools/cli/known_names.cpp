#include "tools/cli/known_names.hpp"

#include <fmt/format.h>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"

namespace aisle::cli {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void check_name(const char* flag, const std::string& name, const std::vector<std::string>& known) {
  for (const std::string& candidate : known)
    if (candidate == name) return;

  const std::string nearest = config::nearest_name(name, known);
  throw config::BadInput(fmt::format("{}: '{}' is unknown; {}there are {}", flag, name,
                                     nearest.empty() ? "" : "did you mean '" + nearest + "'? ", listed(known)));
}

}  // namespace aisle::cli
