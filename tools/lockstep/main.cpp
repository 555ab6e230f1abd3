// aisle-lockstep: drives scenario families without DDS and prints one line a family. For tuning; people use `aisle
// drive`.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "common/process/exit_code.hpp"
#include "services/global-planner/core/variant.hpp"
#include "services/local-planner/core/critic.hpp"
#include "tools/lockstep/suite.hpp"
#include "tools/sim/scenarios/families.hpp"

namespace {

aisle::lockstep::Watch tracer(double period_s) {
  return [period_s, next = 0.0](const aisle::lockstep::Snapshot& now) mutable {
    if (now.t_s < next) return;
    next += period_s;
    for (std::size_t i = 0; i < now.vehicles.size(); ++i)
      std::printf("%7.2f #%zu (%.2f %.2f %.2f) v %.2f w %.2f left %.2f %s/%s %s\n", now.t_s, i + 1, now.vehicles[i].x,
                  now.vehicles[i].y, now.vehicles[i].yaw, now.outputs[i].twist.linear_mps,
                  now.outputs[i].twist.angular_radps, now.outputs[i].distance_left_m, name(now.outputs[i].phase),
                  name(now.outputs[i].reason), now.outputs[i].detail.c_str());
    for (const auto& thing : now.things)
      std::printf("%7.2f thing (%.2f %.2f)\n", now.t_s, thing.base_in_map.x, thing.base_in_map.y);
    for (const auto& seen : now.tracks)
      std::printf("%7.2f track %llu (%.2f %.2f) v (%.2f %.2f) r %.2f%s\n", now.t_s,
                  static_cast<unsigned long long>(seen.track.id), seen.track.position_in_map.x,
                  seen.track.position_in_map.y, seen.track.velocity_in_map.x, seen.track.velocity_in_map.y,
                  seen.track.radius_m, seen.track.is_static ? " static" : "");
  };
}

template <class Variant>
std::vector<std::string> names(const std::vector<Variant>& variants) {
  std::vector<std::string> names;
  for (const Variant& variant : variants) names.push_back(variant.name);
  return names;
}

/// The suite's families with one planner, as one line each. @returns whether nothing was missed or touched
bool run_suite(const std::vector<std::string>& families, const std::string& local, std::uint64_t first, int seeds) {
  std::printf("%-16s %5s %9s %9s %8s %8s %8s %8s %7s %6s\n", local.c_str(), "runs", "goals", "contacts", "moving",
              "least m", "time s", "length m", "turns", "jerk");
  aisle::sim::Totals all;
  for (const std::string& family : families) {
    const aisle::lockstep::SuiteRow row = aisle::lockstep::run_family(family, local, first, seeds);
    const aisle::sim::Totals& t = row.totals;
    std::printf("%-16s %5d %4d/%4d %9d %8d %8.3f %8.1f %8.1f %7.1f %6.2f\n", family.c_str(), t.runs, t.goals_reached,
                t.goals_assigned, t.contacts, t.contacts_moving_vehicle, t.least_clearance_m, t.time_s / t.runs,
                t.distance_m / t.runs, static_cast<double>(t.omega_sign_changes) / t.runs, t.jerk_rms);
    for (const std::string& bad : row.bad) std::printf("    %s\n", bad.c_str());
    std::fflush(stdout);
    all.add(t);
  }
  std::printf("all: goals %d/%d, contacts of a moving vehicle %d\n", all.goals_reached, all.goals_assigned,
              all.contacts_moving_vehicle);
  return all.is_good();
}

struct Wanted {
  std::vector<std::string> families;
  std::uint64_t first{1};
  int seeds{10};
  bool verbose{false};
  bool truth{false};
  bool suite{false};
  double trace_s{0.0};
  std::string local{"wang"};
  std::string global{aisle::sim::Setup{}.planner};
};

aisle::sim::Result run_one(const std::string& family, std::uint64_t seed, const Wanted& wanted) {
  aisle::sim::Setup setup = aisle::sim::named_setup(family, seed);
  setup.local = wanted.local;
  setup.planner = wanted.global;
  if (wanted.truth) setup.perception = aisle::sim::Perception::kTruth;
  const auto result =
      aisle::lockstep::run(setup, wanted.trace_s > 0.0 ? tracer(wanted.trace_s) : aisle::lockstep::Watch{});
  if (!wanted.verbose) return result;
  std::printf("-- %s %d: %d/%d goals, %d contacts, %.1f s\n", family.c_str(), static_cast<int>(seed),
              result.goals_reached, result.goals_assigned, result.contacts, result.time_s);
  for (const std::string& line : result.log) std::printf("%s\n", line.c_str());
  return result;
}

/// One line. @returns whether nothing was missed or touched
bool run_family(const std::string& family, const Wanted& wanted) {
  int assigned = 0, reached = 0, contacts = 0, moving = 0, replans = 0;
  double least = 1e9, time = 0.0, us = 0.0, most_us = 0.0;
  std::string bad;
  for (std::uint64_t seed = wanted.first; seed < wanted.first + static_cast<std::uint64_t>(wanted.seeds); ++seed) {
    const auto result = run_one(family, seed, wanted);
    assigned += result.goals_assigned, reached += result.goals_reached, contacts += result.contacts;
    moving += result.contacts_moving_vehicle, replans += result.replans;
    least = std::min(least, result.least_clearance_m), time += result.time_s, us += result.step_us_mean,
    most_us = std::max(most_us, result.step_us_max);
    if (result.goals_reached < result.goals_assigned || result.contacts_moving_vehicle > 0)
      bad += " " + std::to_string(seed);
  }
  std::printf("%-14.14s %5d %4d/%4d %9d %8d %8.3f %8.1f %7d %6.0f %7.0f%s%s\n",
              std::filesystem::path(family).stem().c_str(), wanted.seeds, reached, assigned, contacts, moving, least,
              time / wanted.seeds, replans, us / wanted.seeds, most_us, bad.empty() ? "" : "  bad:", bad.c_str());
  std::fflush(stdout);
  return bad.empty();
}

bool run_families(const Wanted& wanted) {
  std::printf("%-14s %5s %9s %9s %8s %8s %8s %7s %6s %7s\n", "family", "runs", "goals", "contacts", "moving", "least m",
              "time s", "replans", "us", "max us");
  bool good = true;
  for (const std::string& family : wanted.families.empty() ? aisle::sim::families() : wanted.families)
    good = run_family(family, wanted) && good;
  return good;
}

void add_options(CLI::App& app, Wanted& wanted) {
  app.add_option("family", wanted.families, "families or scenario files; none: all families");
  app.add_option("--first", wanted.first, "first seed");
  app.add_option("--seeds", wanted.seeds, "how many")->check(CLI::Range(1, 1000000));
  app.add_flag("--truth", wanted.truth, "tracks from the truth in sight, not from simulated scans");
  app.add_flag("--verbose", wanted.verbose, "print what happened in each run");
  app.add_option("--local", wanted.local, "local planner")
      ->check(CLI::IsMember(names(aisle::local_planner::all_variants())));
  app.add_option("--global", wanted.global, "global planner")
      ->check(CLI::IsMember(names(aisle::global_planner::all_variants())));
  app.add_flag("--suite", wanted.suite, "the families of the suite, each goal within five times its free run");
  app.add_option("--trace", wanted.trace_s, "print poses and commands every so many seconds")
      ->check(CLI::Range(0.0, 3600.0));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Drives scenario families in lock-step, without DDS"};
  Wanted wanted;
  add_options(app, wanted);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? aisle::process::kDone : aisle::process::kBadInput;
  }
  return aisle::process::run_guarded("aisle-lockstep", [&] {
    if (!wanted.suite) return run_families(wanted) ? 0 : 1;
    return run_suite(wanted.families.empty() ? aisle::lockstep::suite_families() : wanted.families, wanted.local,
                     wanted.first, wanted.seeds)
               ? 0
               : 1;
  });
}
