#include "tools/sim/fault_plan.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <random>

#include "common/config/yaml_reader.hpp"
#include "common/scenario/variation.hpp"

namespace aisle::sim {
namespace {

/// Describes a struct by writing its fields as one YAML flow mapping, in the order of its describe().
class FlowWriter {
 public:
  FlowWriter& field(const char* key, double value, double, double) { return add(key, fmt::format("{}", value)); }
  FlowWriter& field(const char* key, bool value) { return add(key, value ? "true" : "false"); }
  FlowWriter& field(const char* key, const std::string& value) { return add(key, "\"" + value + "\""); }
  void reject(const char*, const std::string&) const {}
  std::string text() const { return "{" + text_ + "}"; }

 private:
  FlowWriter& add(const char* key, const std::string& value) {
    text_ += (text_.empty() ? "" : ", ") + std::string(key) + ": " + value;
    return *this;
  }

  std::string text_;
};

/// Describes a plan: one line an entry of its lists.
class PlanWriter {
 public:
  PlanWriter& field(const char* key, double value, double, double) {
    text_ += fmt::format("{}: {}\n", key, value);
    return *this;
  }

  template <class T>
  PlanWriter& list(const char* key, std::vector<T>& values) {
    if (values.empty()) return *this;

    text_ += std::string(key) + ":\n";

    for (T& value : values) {
      FlowWriter flow;
      value.describe(flow);
      text_ += "  - " + flow.text() + "\n";
    }

    return *this;
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Numbers with two digits, so that a printed plan is the plan to the bit.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(scenario::random_for(seed, "fault-plan")) {}
  int below(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
  bool one_in(int count) { return below(count) == 0; }

  double between(double low, double high) {
    constexpr int kSteps = 1000;
    const double value = low + (high - low) * below(kSteps + 1) / kSteps;
    return static_cast<double>(static_cast<std::int64_t>(value * 100.0 + (value < 0.0 ? -0.5 : 0.5))) / 100.0;
  }

 private:
  std::mt19937_64 random_;
};

/// Moderate: a fleet should still be able to work.
LinkFault random_link(Dice& dice) {
  LinkFault link;
  if (dice.one_in(2)) link.from = "fake-vehicle-*";
  link.begin_s = dice.between(0.0, 20.0);
  link.for_s = dice.between(10.0, 60.0);
  link.loss = dice.between(0.0, 0.15);
  link.delay_ms = dice.between(0.0, 60.0);
  link.jitter_ms = dice.between(0.0, 30.0);
  link.duplicates = dice.between(0.0, 0.1);
  link.reordered = dice.between(0.0, 0.1);

  return link;
}

/// Begins within 25 s and comes again.
template <class T>
T at_some_time(Dice& dice) {
  T occasion;
  occasion.at_s = dice.between(3.0, 25.0);
  occasion.every_s = dice.between(8.0, 25.0);
  return occasion;
}

}  // namespace

bool FaultPlan::is_empty() const {
  return links.empty() && cuts.empty() && crashes.empty() && hangs.empty() && clock_jumps.empty() && disks.empty() &&
         holds.empty() && slows.empty() && deaths.empty();
}

FaultPlan read_fault_plan(const std::filesystem::path& file) {
  FaultPlan plan;
  config::read_yaml_file(file, plan);
  return plan;
}

/// Up to two faults of each kind, up to one clock jump and one disk fault; never none at all.
FaultPlan random_fault_plan(std::uint64_t seed) {
  Dice dice(seed);
  FaultPlan plan;

  for (int i = dice.below(3); i > 0; --i) plan.links.push_back(random_link(dice));

  for (int i = dice.below(3); i > 0; --i) {
    Cut cut = at_some_time<Cut>(dice);
    cut.for_s = dice.between(0.2, 5.0);
    cut.both_ways = dice.one_in(2);
    plan.cuts.push_back(cut);
  }

  for (int i = dice.below(3); i > 0; --i) {
    Crash crash = at_some_time<Crash>(dice);
    crash.restart_after_s = dice.between(0.2, 4.0);
    plan.crashes.push_back(crash);
  }

  for (int i = dice.below(3); i > 0; --i) {
    Hang hang = at_some_time<Hang>(dice);
    hang.for_s = dice.between(0.1, 4.0);
    plan.hangs.push_back(hang);
  }

  for (int i = dice.below(2); i > 0; --i) {
    ClockJump jump = at_some_time<ClockJump>(dice);
    jump.by_s = dice.between(-120.0, 120.0);
    plan.clock_jumps.push_back(jump);
  }

  for (int i = dice.below(2); i > 0; --i) {
    DiskFault disk = at_some_time<DiskFault>(dice);
    disk.kind = dice.one_in(2) ? "full" : dice.one_in(2) ? "torn" : "lost";
    disk.for_s = dice.between(2.0, 10.0);
    plan.disks.push_back(disk);
  }

  if (plan.is_empty()) plan.crashes.push_back(at_some_time<Crash>(dice));
  return plan;
}

std::string to_yaml(const FaultPlan& plan) {
  FaultPlan copy = plan;
  PlanWriter writer;
  copy.describe(writer);
  return writer.text();
}

/// Glob matching with one kind of wildcard, by going back to the last star.
bool is_named(const std::string& pattern, const std::string& name) {
  // A star is tried with no text first, then with one character more each time the rest does not fit.
  std::size_t p = 0, n = 0, star = std::string::npos, resume = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string::npos) {
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }

  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace aisle::sim
