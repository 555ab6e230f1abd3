// aisle goal send: gives a vehicle a goal, and with --wait follows it there.

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"
#include "common/fleet/any_vehicle.hpp"
#include "common/process/exit_code.hpp"
#include "common/scenario/scenario.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/coordinates.hpp"
#include "tools/cli/goal_talk.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

/// The flags with their defaults.
struct SendOptions {
  std::string agv_id;
  std::string pose;
  std::string goal_id;
  std::string scenario;  // with the places that "@dock" names
  bool wait{false};
  double timeout_s{0.0};
  double tolerance_m{0.25};
  double yaw_tolerance_rad{0.15};
};

constexpr Seconds kUntilPlanned{10.0};
constexpr Seconds kUntilArrived{600.0};

/// "@dock" is looked up in the scenario's places. @throws config::BadInput
TypedPose pose_of(const SendOptions& options) {
  if (options.pose.empty() || options.pose.front() != '@') return parse_pose("goal", options.pose);
  if (options.scenario.empty())
    throw config::BadInput("goal: " + options.pose + " is a place of a scenario: name its file with --scenario");

  std::vector<std::string> names;
  for (const scenario::NamedPlace& place : scenario::read_scenario(options.scenario).places) {
    if ("@" + place.name == options.pose) return {place.pose_in_map, place.has_yaw};
    names.push_back("@" + place.name);
  }

  const std::string nearest = config::nearest_name(options.pose, names);
  throw config::BadInput("goal: no place " + options.pose + " in " + options.scenario +
                         (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

/// A goal without a yaw is reached with every heading.
fleet::Goal make_goal(const SendOptions& options) {
  const TypedPose typed = pose_of(options);
  fleet::Goal goal;

  goal.agv_id = options.agv_id;
  goal.id = options.goal_id.empty() ? unique_id("aisle") : options.goal_id;
  goal.pose_in_map = typed.in_map;
  goal.position_tolerance_m = options.tolerance_m;
  goal.yaw_tolerance_rad = typed.has_yaw ? options.yaw_tolerance_rad : 0.0;

  return goal;
}

/// One line that replaces itself in a terminal; elsewhere a line whenever the phase changes.
class GoalProgress {
 public:
  void show(const fleet::NavigationStatus& status) {
    const std::string phase = name(status.phase);
    const std::string reason = status.reason == fleet::Reason::kNone ? "" : " (" + word_of(name(status.reason)) + ")";
    const std::string line = fmt::format("{} {}{}, {:.1f} m and {:.0f} s left", printable(status.agv_id), phase, reason,
                                         status.distance_left_m, status.time_left_s);

    if (is_terminal_) {
      std::fprintf(stderr, "\r\x1b[K%s", line.c_str());
      is_open_ = true;
    } else if (phase + reason != last_) {
      std::fprintf(stderr, "%s\n", line.c_str());
    }

    last_ = phase + reason;
  }

  ~GoalProgress() {
    if (is_open_) std::fprintf(stderr, "\n");
  }

 private:
  bool is_terminal_{isatty(STDERR_FILENO) != 0};
  bool is_open_{false};
  std::string last_;
};

/// Prints the result and returns `code`. `length_m`: of the plan, when there is one.
int report_sent(const Cli& cli, const fleet::Goal& goal, const std::string& result, const std::string& text, int code,
                double length_m = -1.0) {
  if (cli.json) {
    Json json{{"agv_id", goal.agv_id}, {"goal_id", goal.id}, {"result", result}, {"text", text}};
    if (length_m >= 0.0) json["length_m"] = length_m;
    std::printf("%s\n", write_json(json).c_str());
  } else {
    std::fprintf(code == process::kDone ? stdout : stderr, "%s\n", printable(text).c_str());
  }

  return code;
}

/// Tells a planner that is not there from one that does not answer.
int report_no_answer(const Cli& cli, const GoalTalk& talk, const fleet::Goal& goal, double waited_s) {
  if (goal.agv_id == fleet::kAnyVehicle) {
    return report_sent(cli, goal, "no_answer",
                       fmt::format("no vehicle was given the goal within {:g} s: is aisle-dispatcher running? It gives "
                                   "the goal when a vehicle is free",
                                   waited_s),
                       process::kEnvironment);
  }

  const bool nobody = !talk.is_read_by_anybody();
  return report_sent(
      cli, goal, "no_answer",
      fmt::format("no plan for the goal within {:g} s: {}", waited_s,
                  nobody ? "nobody reads goals; is aisle-global-planner running?"
                         : "aisle-global-planner does not answer; see aisle fleet for what it waits for"),
      process::kEnvironment);
}

/// Shows the vehicle's progress until it arrives, fails or gets another goal, or until `limit`.
int follow(const Cli& cli, GoalTalk& talk, const fleet::Goal& goal, Seconds limit) {
  const std::string goal_id = goal.id;
  const std::string& agv_id = talk.agv_id();
  const auto is_over = [](fleet::Phase phase) {
    return phase == fleet::Phase::kArrived || phase == fleet::Phase::kFailed;
  };

  // Until it is over, or another goal takes its place.
  std::string replaced_by;
  bool is_over_now = false;

  {
    GoalProgress progress;

    is_over_now = talk.listen_until(limit, [&] {
      const bool is_other_plan = talk.plan() && talk.plan()->goal_id != goal_id;
      if (is_other_plan) replaced_by = talk.plan()->goal_id;

      if (is_other_plan) return true;
      if (!talk.navigation() || talk.navigation()->goal_id != goal_id) return false;

      progress.show(*talk.navigation());
      return is_over(talk.navigation()->phase);
    });
  }

  if (!replaced_by.empty())
    return report_sent(cli, goal, "replaced", agv_id + " has another goal now: " + replaced_by, process::kNegative);

  if (!is_over_now) {
    const std::string why = is_interrupted() ? "interrupted" : fmt::format("not there after {:g} s", limit.count());
    return report_sent(cli, goal, "not_arrived", why + "; " + agv_id + " keeps the goal, aisle goal cancel drops it",
                       process::kNegative);
  }

  const fleet::NavigationStatus& status = *talk.navigation();
  if (status.phase == fleet::Phase::kArrived)
    return report_sent(cli, goal, "arrived", agv_id + " arrived", process::kDone);

  return report_sent(cli, goal, "failed", agv_id + " failed (" + word_of(name(status.reason)) + "): " + status.detail,
                     process::kNegative);
}

/// Says the goal until there is a plan for it; with --wait follows the vehicle then.
int send(const Cli& cli, const SendOptions& options) {
  fleet::Goal goal = make_goal(options);
  const std::string goal_id = goal.id;
  GoalTalk talk(cli, options.agv_id);

  talk.require_vehicle();

  // Said until a plan for it comes.
  const Seconds until_planned = options.timeout_s > 0.0 ? Seconds(options.timeout_s) : kUntilPlanned;
  const auto is_planned = [&] { return talk.plan() && talk.plan()->goal_id == goal_id; };
  if (!talk.say_until(goal, until_planned, is_planned)) return report_no_answer(cli, talk, goal, until_planned.count());

  const fleet::Plan plan = *talk.plan();
  goal.agv_id = plan.agv_id;
  if (!plan.is_found()) {
    const std::string outcome = word_of(name(plan.outcome));
    return report_sent(cli, goal, outcome, goal.agv_id + " cannot go there: " + outcome + ": " + plan.detail,
                       process::kNegative);
  }

  const std::string text =
      fmt::format("{} goes {:.1f} m to {}, goal {}", goal.agv_id, plan.length_m, options.pose, goal_id);
  if (!options.wait) return report_sent(cli, goal, "planned", text, process::kDone, plan.length_m);

  if (!cli.json) std::printf("%s\n", printable(text).c_str());
  std::fflush(stdout);

  return follow(cli, talk, goal, options.timeout_s > 0.0 ? Seconds(options.timeout_s) : kUntilArrived);
}

}  // namespace

void add_goal_send(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<SendOptions>();
  Verb(parent, cli, "send", "send a vehicle to a pose; exit code 1 when it cannot get there")
      .argument("agv", options->agv_id, "vehicle, e.g. agv-1; any: the dispatcher chooses one")
      .argument("pose", options->pose, "X,Y or X,Y,YAW in metres and radians, map frame; @NAME with --scenario")
      .flag("--wait", options->wait, "wait until it arrived, with a line of progress")
      .option("--timeout", options->timeout_s, 0.0, 1e6, "give up after so many seconds; 0: 10, with --wait 600")
      .option("--tolerance", options->tolerance_m, 0.01, 10.0, "how near is there, in metres")
      .option("--yaw-tolerance", options->yaw_tolerance_rad, 0.01, 3.15, "in radians, when a yaw is given")
      .option("--scenario", options->scenario, "file whose places @NAME means")
      .option("--id", options->goal_id, "id of the goal; one is made when not given")
      .runs([&cli, options] { return send(cli, *options); });
}

}  // namespace aisle::cli
