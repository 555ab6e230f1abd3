// aisle goal cancel: drops a vehicle's goal; it brakes and holds.

#include <cstdio>
#include <memory>
#include <string>

#include "common/process/exit_code.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/goal_talk.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

constexpr Seconds kUntilGoalIsKnown{1.5};

/// The goal that the vehicle has, by the newest of its own word, the plan's and the goal's; empty:
/// none.
std::string open_goal_of(const GoalTalk& talk) {
  if (talk.navigation() && !talk.navigation()->goal_id.empty()) return talk.navigation()->goal_id;
  if (talk.plan() && !talk.plan()->is_cancelled()) return talk.plan()->goal_id;
  return talk.goal() && !talk.goal()->is_cancelled ? talk.goal()->id : "";
}

/// Did planner or vehicle confirm it?
bool is_cancelled(const GoalTalk& talk, const std::string& goal_id) {
  const bool by_planner = talk.plan() && talk.plan()->goal_id == goal_id && talk.plan()->is_cancelled();
  const bool by_vehicle = talk.navigation() && talk.navigation()->reason == fleet::Reason::kCancelled;
  return by_planner || by_vehicle;
}

/// Prints the result and returns `code`.
int report_cancelled(const Cli& cli, const GoalTalk& talk, const std::string& goal_id, const std::string& result,
                     const std::string& text, int code) {
  if (cli.json) {
    std::printf(
        "%s\n",
        write_json(Json{{"agv_id", talk.agv_id()}, {"goal_id", goal_id}, {"result", result}, {"text", text}}).c_str());
  } else {
    std::fprintf(code == process::kDone ? stdout : stderr, "%s\n", printable(text).c_str());
  }

  return code;
}

/// Finds the vehicle's goal, then says that it is cancelled until a planner or the vehicle confirms it.
int cancel(const Cli& cli, const std::string& agv_id, double timeout_s) {
  GoalTalk talk(cli, agv_id);
  talk.require_vehicle();
  talk.listen_until(kUntilGoalIsKnown, [&] { return !open_goal_of(talk).empty(); });

  const std::string goal_id = open_goal_of(talk);
  if (goal_id.empty()) return report_cancelled(cli, talk, "", "no_goal", agv_id + " has no goal", process::kNegative);
  if (is_cancelled(talk, goal_id))
    return report_cancelled(cli, talk, goal_id, "cancelled", "goal " + goal_id + " was cancelled before",
                            process::kDone);

  // The same goal, cancelled.
  fleet::Goal goal;
  goal.agv_id = agv_id;
  goal.id = goal_id;
  goal.position_tolerance_m = 0.0;
  goal.is_cancelled = true;

  if (talk.say_until(goal, Seconds(timeout_s), [&] { return is_cancelled(talk, goal_id); })) {
    return report_cancelled(cli, talk, goal_id, "cancelled", agv_id + " dropped goal " + goal_id, process::kDone);
  }

  return report_cancelled(cli, talk, goal_id, "no_answer",
                          "nobody confirmed that goal " + goal_id + " is dropped; is aisle-global-planner running?",
                          process::kEnvironment);
}

}  // namespace

void add_goal_cancel(CLI::App& parent, Cli& cli) {
  struct Options {
    std::string agv_id;
    double timeout_s{10.0};
  };

  auto options = std::make_shared<Options>();
  Verb(parent, cli, "cancel", "drop a vehicle's goal: it brakes and holds; exit code 1 when it has none")
      .argument("agv", options->agv_id, "vehicle, e.g. agv-1")
      .option("--timeout", options->timeout_s, 0.1, 1e6, "give up after so many seconds")
      .runs([&cli, options] { return cancel(cli, options->agv_id, options->timeout_s); });
}

}  // namespace aisle::cli
