#include "tools/sim/fault_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "common/config/nearest_name.hpp"
#include "common/scenario/variation.hpp"

namespace aisle::sim {
namespace {

using Kind = FaultAction::Kind;

const std::string kVehicle = "fake-vehicle-";  // with an id behind it: the process that simulates the vehicle
constexpr int kMostDraws = 100;                // until the ends of a cut differ

/// Lays a plan out: draws the processes in the order of the plan, then sorts by time.
class Layout {
 public:
  Layout(const FaultPlan& plan, const std::vector<std::string>& services, const std::vector<std::string>& others,
         std::uint64_t seed)
      : plan_(plan), services_(services), others_(others), random_(scenario::random_for(seed, "faults")) {}

  /// Kinds in a fixed order: each draw depends on those before it.
  std::vector<FaultAction> all() {
    add_links();
    for (const Cut& cut : plan_.cuts) add_cut(cut);

    for (const Crash& crash : plan_.crashes)
      add_pair(crash, crash.process, crash.restart_after_s, Kind::kCrash, Kind::kStart);

    for (const Hang& hang : plan_.hangs) add_pair(hang, hang.process, hang.for_s, Kind::kHang, Kind::kGoOn);

    for (const ClockJump& jump : plan_.clock_jumps) {
      for (const double t_s : times_of(jump))
        actions_.push_back({t_s, Kind::kClockJump, one_of(jump.process), "", false, jump.by_s, ++faults_});
    }

    for (const DiskFault& disk : plan_.disks) add_disk(disk);
    for (const Hold& hold : plan_.holds) add_holds(hold);
    for (const Slow& slow : plan_.slows) add_slow(slow);
    for (const Death& death : plan_.deaths) add_deaths(death);

    std::stable_sort(actions_.begin(), actions_.end(),
                     [](const FaultAction& a, const FaultAction& b) { return a.t_s < b.t_s; });

    return std::move(actions_);
  }

 private:
  /// All occasions before the plan stops.
  std::vector<double> times_of(const Occasion& occasion) const {
    std::vector<double> times;
    for (int i = 0;; ++i) {
      const double t_s = occasion.at_s + i * occasion.every_s;
      if (t_s >= plan_.stop_s) return times;
      times.push_back(t_s);
      if (occasion.every_s <= 0.0) return times;
    }
  }

  /// `reaches_others`: a pattern that fits no service may mean the world's processes.
  std::string one_of(const std::string& pattern, bool reaches_others = false) {
    std::vector<std::string> fitting, others;
    for (const std::string& name : services_)
      if (is_named(pattern, name)) fitting.push_back(name);

    for (const std::string& name : others_)
      if (pattern == name || (fitting.empty() && reaches_others && is_named(pattern, name))) others.push_back(name);

    if (fitting.empty()) fitting = others;
    if (fitting.empty()) refuse(pattern);

    return fitting[random_() % fitting.size()];
  }

  /// Does the pattern stand for any process?
  bool fits_any(const std::string& pattern) const {
    const auto fits = [&](const std::string& name) { return is_named(pattern, name); };
    return std::any_of(services_.begin(), services_.end(), fits) || std::any_of(others_.begin(), others_.end(), fits);
  }

  /// Names the nearest process and all there are.
  [[noreturn]] void refuse(const std::string& pattern) const {
    std::vector<std::string> known = services_;
    known.insert(known.end(), others_.begin(), others_.end());

    const std::string nearest = config::nearest_name(pattern, known);
    std::string names;

    for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
    throw config::BadInput("fault plan: no process is named '" + pattern + "'; " +
                           (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") + "there are " + names);
  }

  /// Two changes for each link: when its harm begins and when it ends.
  void add_links() {
    for (const LinkFault& link : plan_.links) {
      if (!fits_any(link.from)) refuse(link.from);
      if (!fits_any(link.to)) refuse(link.to);

      if (link.begin_s >= plan_.stop_s) continue;

      actions_.push_back({link.begin_s, Kind::kLinksChange});
      actions_.push_back({std::min(link.begin_s + link.for_s, plan_.stop_s), Kind::kLinksChange});
    }
  }

  /// Draws both ends anew until they differ.
  void add_cut(const Cut& cut) {
    for (const double t_s : times_of(cut)) {
      const std::string from = one_of(cut.from, true);
      std::string to = one_of(cut.to, true);

      for (int i = 0; to == from && i < kMostDraws; ++i) to = one_of(cut.to, true);
      actions_.push_back({t_s, Kind::kCut, from, to, cut.both_ways});
      actions_.push_back({std::min(t_s + cut.for_s, plan_.stop_s), Kind::kHeal, from, to, cut.both_ways});
    }
  }

  /// A fault that begins and ends on one process.
  void add_pair(const Occasion& occasion, const std::string& process, double for_s, Kind begin, Kind end) {
    for (const double t_s : times_of(occasion)) {
      const std::string name = one_of(process);
      const int fault = ++faults_;
      actions_.push_back({t_s, begin, name, "", false, 0.0, fault});
      actions_.push_back({std::min(t_s + for_s, plan_.stop_s), end, name, "", false, 0.0, fault});
    }
  }

  /// Full for a while, or its files harmed at once.
  void add_disk(const DiskFault& disk) {
    if (disk.kind == "full") return add_pair(disk, disk.process, disk.for_s, Kind::kDiskFull, Kind::kDiskFree);
    const Kind kind = disk.kind == "torn" ? Kind::kFilesTorn : Kind::kFilesLost;
    for (const double t_s : times_of(disk))
      actions_.push_back({t_s, kind, one_of(disk.process), "", false, 0.0, ++faults_});
  }

  /// Processes of the vehicles that the pattern names, by their ids.
  std::vector<std::string> vehicles_of(const std::string& pattern) const {
    std::vector<std::string> named;
    for (const std::string& name : others_)
      if (is_named(kVehicle + pattern, name)) named.push_back(name);

    if (named.empty()) refuse(kVehicle + pattern);
    return named;
  }

  /// A pair of actions that begin and end on one vehicle.
  void add_on_vehicle(const std::string& process, double begin_s, double for_s, Kind begin, Kind end, double share) {
    if (begin_s >= plan_.stop_s) return;
    const int fault = ++faults_;
    actions_.push_back({begin_s, begin, process, "", false, 0.0, fault, share});
    actions_.push_back({std::min(begin_s + for_s, plan_.stop_s), end, process, "", false, 0.0, fault, share});
  }

  /// Once a period for each vehicle; the moment and how long are drawn.
  void add_holds(const Hold& hold) {
    const std::vector<std::string> vehicles = vehicles_of(hold.vehicle);
    for (int i = 0; hold.begin_s + i * hold.every_s < plan_.stop_s; ++i) {
      for (const std::string& vehicle : vehicles) {
        const double at_s = hold.begin_s + (i + share_drawn()) * hold.every_s;
        const double for_s = hold.least_s + share_drawn() * (hold.most_s - hold.least_s);
        add_on_vehicle(vehicle, at_s, for_s, Kind::kHold, Kind::kLetGo, 1.0);
      }
    }
  }

  void add_slow(const Slow& slow) {
    for (const std::string& vehicle : vehicles_of(slow.vehicle))
      add_on_vehicle(vehicle, slow.begin_s, slow.for_s, Kind::kSlow, Kind::kFast, slow.share);
  }

  /// None where all that are named have died before.
  void add_deaths(const Death& death) {
    for (const double t_s : times_of(death)) {
      std::vector<std::string> living;
      for (const std::string& vehicle : vehicles_of(death.vehicle))
        if (dead_.count(vehicle) == 0) living.push_back(vehicle);

      if (living.empty()) return;

      const std::string& vehicle = living[random_() % living.size()];
      dead_.insert(vehicle);
      ++faults_;
      actions_.push_back({t_s, Kind::kDeath, vehicle, "", false, 0.0, faults_});
      actions_.push_back({t_s + death.signed_off_after_s, Kind::kSignOff, vehicle, "", false, 0.0, faults_});
    }
  }

  /// From 0 on, below 1, in steps of a thousandth: the same on every machine.
  double share_drawn() { return static_cast<double>(random_() % 1000) / 1000.0; }

  const FaultPlan& plan_;
  const std::vector<std::string>& services_;
  const std::vector<std::string>& others_;
  std::mt19937_64 random_;
  int faults_{0};
  std::set<std::string> dead_;
  std::vector<FaultAction> actions_;
};

/// The share that at least one of two independent causes hits: 1 - (1 - a)(1 - b).
double either(double a, double b) { return 1.0 - (1.0 - a) * (1.0 - b); }

}  // namespace

const char* name_of(FaultAction::Kind kind) {
  switch (kind) {
    case Kind::kCut:
      return "cut";
    case Kind::kCrash:
      return "crash";
    case Kind::kHang:
      return "hang";
    case Kind::kClockJump:
      return "clock_jump";
    case Kind::kDiskFull:
      return "disk_full";
    case Kind::kFilesTorn:
      return "files_torn";
    case Kind::kFilesLost:
      return "files_lost";
    case Kind::kHold:
      return "hold";
    case Kind::kSlow:
      return "slow";
    case Kind::kDeath:
      return "death";
    case Kind::kSignOff:
      return "sign_off";
    case Kind::kLinksChange:
    case Kind::kHeal:
    case Kind::kStart:
    case Kind::kGoOn:
    case Kind::kDiskFree:
    case Kind::kLetGo:
    case Kind::kFast:
      return "";
  }

  return "";
}

std::vector<FaultAction> schedule(const FaultPlan& plan, const std::vector<std::string>& services,
                                  const std::vector<std::string>& others, std::uint64_t seed) {
  return Layout(plan, services, others, seed).all();
}

std::chrono::nanoseconds moment_of(double s) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(std::llround(s * 1e9)));
}

/// The causes that hold at this moment between these two, put together.
LinkFault harm_at(const FaultPlan& plan, std::chrono::nanoseconds t, const std::string& from, const std::string& to) {
  LinkFault all;
  all.reorder_ms = 0.0;

  if (t >= moment_of(plan.stop_s)) return all;

  for (const LinkFault& link : plan.links) {
    if (t < moment_of(link.begin_s) || t >= moment_of(link.begin_s + link.for_s)) continue;
    if (!is_named(link.from, from) || !is_named(link.to, to)) continue;

    all.loss = either(all.loss, link.loss);
    all.duplicates = either(all.duplicates, link.duplicates);
    all.reordered = either(all.reordered, link.reordered);
    all.delay_ms += link.delay_ms;
    all.jitter_ms += link.jitter_ms;
    if (link.reordered > 0.0) all.reorder_ms = std::max(all.reorder_ms, link.reorder_ms);
  }

  return all;
}

}  // namespace aisle::sim
