#include "services/global-planner/core/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace aisle::global_planner {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void require_choice(const std::string& name, const std::string& value, const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), value) == choices.end())
    throw std::invalid_argument(name + ": '" + value + "' is not one of " + joined(choices));
}

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t comma = text.find(','); comma != std::string::npos; from = comma + 1, comma = text.find(',', from))
    parts.push_back(text.substr(from, comma - from));
  parts.push_back(text.substr(from));
  return parts;
}

}  // namespace

std::string Parameters::text(const std::string& name, const std::string& default_value, const std::string& meaning,
                             const std::string& range) {
  const auto found = set_.find(name);
  known_.push_back({name, found == set_.end() ? default_value : found->second, meaning, range});
  return known_.back().value;
}

double Parameters::number(const std::string& name, double default_value, double low, double high,
                          const std::string& meaning) {
  const std::string value = text(name, fmt::format("{}", default_value), meaning, fmt::format("{} to {}", low, high));
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  const bool is_number = !value.empty() && *end == '\0' && std::isfinite(number);
  if (!is_number || number < low || number > high)
    throw std::invalid_argument(fmt::format("{}: '{}' is no number from {} to {}", name, value, low, high));
  return number;
}

std::string Parameters::word(const std::string& name, const std::string& default_value,
                             const std::vector<std::string>& choices, const std::string& meaning) {
  const std::string value = text(name, default_value, meaning, "one of " + joined(choices));
  require_choice(name, value, choices);
  return value;
}

std::vector<std::string> Parameters::words(const std::string& name, const std::string& default_value,
                                           const std::vector<std::string>& choices, const std::string& meaning) {
  const std::string value =
      text(name, default_value, meaning, "any of " + joined(choices) + ", in this order; or none");
  if (value == "none") return {};
  const std::vector<std::string> words = split_at_commas(value);
  for (const std::string& word : words) require_choice(name, word, choices);
  return words;
}

void Parameters::refuse_unknown() const {
  std::vector<std::string> names;
  for (const Parameter& parameter : known_) names.push_back(parameter.name);
  for (const auto& [name, value] : set_) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw std::invalid_argument(name + " is no parameter of this planner" +
                                  (names.empty() ? "; it has none" : "; there are " + joined(names)));
  }
}

}  // namespace aisle::global_planner
