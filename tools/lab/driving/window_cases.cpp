#include "tools/lab/driving/window_cases.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/process/output_file.hpp"
#include "tools/lab/driving/window_svg.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/sim/scenarios/building.hpp"
#include "tools/sim/site.hpp"

namespace aisle::lab {
namespace {

using geometry::Point2;

constexpr double kLineM = 5.0;  // y of start and goal
constexpr double kStartM = 2.0;
constexpr double kGoalM = 18.0;

/// From the scenario's second zero until its vehicle begins to drive: it gets its goal, and the tracker has to use a
/// scan of it first. Movers, which meet the vehicle at a certain place, start so much later.
constexpr double kStartDelayS = 0.2;

sim::Setup straight(double aisle_m) {
  sim::Setup setup;
  setup.grid = sim::hall(20.0, 10.0, 0.1);
  if (aisle_m < 9.0) {
    sim::block(setup.grid, 0.0, 0.0, 20.0, kLineM - 0.5 * aisle_m);
    sim::block(setup.grid, 0.0, kLineM + 0.5 * aisle_m, 20.0, 10.0);
  }
  sim::add_vehicle(setup, 1, {kStartM, kLineM, 0.0}, {{kGoalM, kLineM, 0.0}});
  setup.local = "wu";
  setup.scenario.duration_s = 60.0;
  return setup;
}

WindowCase crosser(std::string name, std::string title, double mps, double start_s) {
  WindowCase of{std::move(name), std::move(title), straight(10.0)};
  sim::add_mover(of.setup, mps, start_s + kStartDelayS, false, {{10.0, 1.0}, {10.0, 9.0}});
  return of;
}

void add_box(sim::Setup& setup, double length_m, double width_m) {
  scenario::Block box;
  box.id = "box";
  box.center_in_map = {10.0, kLineM, 0.0};
  box.length_m = length_m;
  box.width_m = width_m;
  setup.scenario.blocks.push_back(box);
}

WindowScene scene_of(const WindowCase& of, const WindowDrive& drive) {
  WindowScene scene;
  scene.title = of.title;
  scene.start_in_map = {kStartM, kLineM};
  scene.goal_in_map = {kGoalM, kLineM};
  scene.vehicle_radius_m = of.setup.scenario.vehicles.front().radius_m;
  scene.driven_in_map = drive.driven_in_map;
  for (const scenario::Mover& mover : of.setup.scenario.movers) scene.mover_radius_m = mover.radius_m;
  scene.mover_in_map = drive.mover_in_map;
  scene.sub_targets = drive.sub_targets;
  for (const scenario::Block& b : of.setup.scenario.blocks) {
    const Point2 half{0.5 * b.length_m, 0.5 * b.width_m};
    scene.boxes.push_back({b.center_in_map.position() - half, b.center_in_map.position() + half});
  }
  return scene;
}

/// What is kept of a snapshot until it is known when the drive began.
struct Moment {
  double t_s{0.0};  // since the site began
  Point2 vehicle_in_map;
  std::optional<Point2> mover_in_map;
  local_planner::Output output;
};

Moment moment_of(const sim::Snapshot& now) {
  Moment moment{now.t_s, now.vehicles_in_map[0].position(), {}, now.outputs[0]};
  for (const geometry::Body& thing : now.things)
    if (thing.shape == geometry::Body::Shape::kDisc) moment.mover_in_map = thing.base_in_map.position();
  return moment;
}

/// One more moment of a drive, `since_s` after the one before.
void add(WindowDrive& drive, const Moment& now, double since_s) {
  const Point2 here = now.vehicle_in_map;
  drive.driven_in_map.push_back(here);
  if (now.mover_in_map) drive.mover_in_map.push_back(*now.mover_in_map);
  if (const auto& sub_target = now.output.sub_target_in_map) {
    drive.sub_targets.push_back({here, *sub_target});
    drive.sub_target_s += since_s;
  }
  drive.farthest_off_m = std::max(drive.farthest_off_m, std::abs(here.y - kLineM));
  drive.back_on_it_m = std::abs(here.y - kLineM);
  if (here.x > kStartM + 3.0 && here.x < kGoalM - 3.0)
    drive.slowest_mps = std::min(drive.slowest_mps, now.output.twist.linear_mps);
  drive.asked_for_a_plan = drive.asked_for_a_plan || now.output.phase == local_planner::Phase::kBlocked;
}

}  // namespace

std::vector<WindowCase> window_cases() {
  std::vector<WindowCase> cases;
  cases.push_back(crosser("window-ahead", "fast crosser passes ahead", 1.5, 0.5));
  cases.push_back(crosser("window-behind", "slow crosser passes behind", 0.5, 6.5));
  cases.push_back(crosser("window-collision", "collision course, crossing", 0.8, 2.2));
  cases.push_back({"window-oncoming", "collision course, oncoming; keeps right, as by default", straight(10.0)});
  cases.back().setup.settings.lane = {};
  sim::add_mover(cases.back().setup, 0.6, kStartDelayS, false, {{17.0, kLineM}, {2.0, kLineM}});
  cases.push_back({"window-box", "unknown box on the path", straight(10.0)});
  add_box(cases.back().setup, 0.8, 0.8);
  cases.push_back({"window-closed", "aisle closed by something unknown", straight(2.0)});
  add_box(cases.back().setup, 0.4, 2.4);
  return cases;
}

WindowDrive drive_window_case(const WindowCase& of) {
  std::vector<Moment> moments;
  sim::Hooks hooks;
  hooks.watch = [&](const sim::Snapshot& now) { moments.push_back(moment_of(now)); };
  WindowDrive drive;
  drive.result = sim::drive(of.setup, {}, hooks).result;

  const double begin_s = drive.result.first_goal_s;
  const double end_s = begin_s + drive.result.driven_s;
  double looked_s = begin_s;
  for (const Moment& now : moments) {
    if (now.t_s < begin_s || now.t_s > end_s) continue;
    add(drive, now, now.t_s - std::exchange(looked_s, now.t_s));
  }
  return drive;
}

WindowTable window_table(const std::filesystem::path& pictures, const std::string& pictures_from_page,
                         const Progress& progress) {
  std::vector<std::vector<std::string>> rows{{"case", "goal", "contacts", "farthest off the path m",
                                              "off it at the end m", "slowest m/s", "aimed at a sub-target s",
                                              "asked for another plan"}};
  std::string shown;
  for (const WindowCase& of : window_cases()) {
    progress("window: " + of.title);
    const WindowDrive d = drive_window_case(of);
    rows.push_back({of.title, d.result.goals_reached == 1 ? "reached" : "not reached",
                    std::to_string(d.result.contacts), digits(d.farthest_off_m, 2), digits(d.back_on_it_m, 2),
                    digits(d.slowest_mps, 2), digits(d.sub_target_s, 1), d.asked_for_a_plan ? "yes" : "no"});
    process::write_output_file(pictures / (of.name + ".svg"), window_svg(of.setup.grid, scene_of(of, d)));
    shown += "![" + of.title + "](" + pictures_from_page + "/" + of.name + ".svg)\n\n";
  }
  return {markdown_table(rows), shown};
}

}  // namespace aisle::lab
