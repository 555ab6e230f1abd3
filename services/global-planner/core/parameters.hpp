#pragma once
#include <map>
#include <string>
#include <vector>

namespace aisle::global_planner {

/// One parameter of a planner, for experiments.
struct Parameter {
  std::string name;
  std::string value;    // in use: the default, or what was set
  std::string meaning;  // one line, with its source
  std::string range;    // "0 to 100", "one of a, b", "any of a, b in this order, or none"
};

/// The parameters of a planner by name. A variant declares them by reading them: each reading names the default, the
/// range and the meaning, so that an empty set makes the planner as published and lists what may be set.
/// Texts that are no such value are refused with std::invalid_argument.
class Parameters {
 public:
  void set(const std::string& name, const std::string& value) { set_[name] = value; }

  /// A number from `low` to `high`, both included.
  double number(const std::string& name, double default_value, double low, double high, const std::string& meaning);
  /// One of `choices`.
  std::string word(const std::string& name, const std::string& default_value, const std::vector<std::string>& choices,
                   const std::string& meaning);
  /// Any of `choices`, joined by commas, in that order; "none": an empty list.
  std::vector<std::string> words(const std::string& name, const std::string& default_value,
                                 const std::vector<std::string>& choices, const std::string& meaning);

  /// Those that were read, in that order.
  const std::vector<Parameter>& known() const { return known_; }
  /// @throws std::invalid_argument when something was set that no reading asked for, with all names
  void refuse_unknown() const;

 private:
  std::string text(const std::string& name, const std::string& default_value, const std::string& meaning,
                   const std::string& range);

  std::map<std::string, std::string> set_;
  std::vector<Parameter> known_;
};

}  // namespace aisle::global_planner
