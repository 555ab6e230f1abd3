#include "tools/sim/site.hpp"

#include <fmt/format.h>
#include <spdlog/details/null_mutex.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/base_sink.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>
#include <set>
#include <utility>

#include "tools/referee/referee_service.hpp"
#include "tools/sim/drive_recorder.hpp"
#include "tools/sim/fault_schedule.hpp"
#include "tools/sim/process.hpp"
#include "tools/sim/services.hpp"
#include "tools/sim/spectator.hpp"
#include "tools/sim/sqlite_on_disk.hpp"
#include "tools/sim/supervisor.hpp"

namespace aisle::sim {
namespace {

using bus::simulated::Link;
using bus::simulated::Network;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr milliseconds kBetweenStarts{7};  // as a supervisor starts processes: each has a boot id of its own
constexpr milliseconds kLook{50};          // whether the run is over
constexpr int kShowEvery = 2;              // looks from one snapshot to the next
constexpr seconds kRestart{1};             // of a process that ended by itself
constexpr const char* kReferee = "referee";

/// Hands what services log to the run's own ears.
class LineSink final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 public:
  explicit LineSink(std::function<void(const std::string&)> say) : say_(std::move(say)) {}

 protected:
  void sink_it_(const spdlog::details::log_msg& line) override {
    say_(std::string(line.logger_name.begin(), line.logger_name.end()) + ": " +
         std::string(line.payload.begin(), line.payload.end()));
  }
  void flush_() override {}

 private:
  std::function<void(const std::string&)> say_;
};

nanoseconds of_milliseconds(double ms) { return nanoseconds(static_cast<std::int64_t>(ms * 1e6)); }

referee::Expectation expectation_of(const scenario::Scenario& scenario) {
  referee::Expectation expectation;
  for (const scenario::Mission& mission : scenario.missions)
    expectation.goals_of[mission.vehicle] += static_cast<int>(mission.goals_in_map.size()) * mission.loops;
  expectation.goals_of_any = scenario.goal_count() - expectation.goals();
  return expectation;
}

/// The faults that lie on a process now, by their numbers in the plan: it recovers when the last of a kind is over.
struct Burden {
  std::set<int> downs, hangs, full_disk, holds;
  std::map<int, double> slows;  // shares of the top speed
};

class Site {
 public:
  Site(const Setup& setup, const Faults& faults, const Hooks& hooks)
      : setup_(setup),
        faults_(faults),
        hooks_(hooks),
        log_(std::make_shared<spdlog::logger>("site", std::make_shared<LineSink>([this](const auto& l) { say(l); }))),
        network_(setup.seed * 1'000'003 + faults.seed),
        begun_(network_.now()),
        walls_(setup.grid),
        referee_bus_(network_.join(settings_of(kReferee), kReferee)),
        referee_shell_(*referee_bus_, {kReferee, kReferee, "", 1, kReferee, 1}, {log_->clone(kReferee), {}, {}}),
        referee_(referee_shell_, walls_, expectation_of(setup.scenario)),
        recorder_(referee_shell_) {
    log_->set_level(hooks_.says ? spdlog::level::info : spdlog::level::off);
    put_sqlite_on_simulated_disks();
    referee_bus_->drive();
    for (Blueprint& blueprint : blueprints_of(setup, hindrances_, seat_spectator())) add(std::move(blueprint));
    plan_faults();
  }

  Outcome run() {
    std::string because;
    double asked_s = -1.0;
    for (int look = 0; because.empty(); ++look) {
      network_.advance_to(network_.now() + kLook);
      const double t_s = now_s();
      recorder_.look(referee_shell_.now());
      if (referee_.is_over()) because = "all missions are over";
      if (t_s >= setup_.scenario.duration_s) because = fmt::format("{:.0f} s are over", setup_.scenario.duration_s);
      if (hooks_.goes_on && t_s - asked_s >= 1.0 && !hooks_.goes_on(asked_s = t_s)) because = "stopped";
      if (hooks_.watch && look % kShowEvery == 0 && spectator_->sees_all_vehicles())
        hooks_.watch(spectator_->look(t_s));
    }
    return outcome(because);
  }

 private:
  static bus::Settings settings_of(const std::string& name) {
    bus::Settings settings;
    settings.participant_name = name;
    return settings;
  }

  double now_s() const { return std::chrono::duration<double>(network_.now() - begun_).count(); }

  void say(const std::string& text) {
    if (hooks_.says) hooks_.says(fmt::format("{:8.3f} {}", now_s(), text));
  }

  /// Where nobody watches, nothing is heard for them.
  HearsCycle seat_spectator() {
    if (!hooks_.watch && !hooks_.on_cycle) return {};
    spectator_.emplace(referee_shell_, setup_.scenario);
    return [this](const std::string& agv_id, const local_planner::Output& output, double compute_us) {
      spectator_->hear(agv_id, output);
      if (hooks_.on_cycle && spectator_->sees_all_vehicles()) tell_cycle(agv_id, output, compute_us);
    };
  }

  void tell_cycle(const std::string& agv_id, const local_planner::Output& output, double compute_us) {
    const Snapshot now = spectator_->look(now_s());
    for (std::size_t i = 0; i < setup_.scenario.vehicles.size(); ++i)
      if (setup_.scenario.vehicles[i].id == agv_id)
        hooks_.on_cycle({now.t_s, agv_id, now.vehicles_in_map[i], output, compute_us, now});
  }

  void add(Blueprint blueprint) {
    const std::string name = blueprint.name();
    auto process = std::make_unique<Process>(
        network_, std::move(blueprint), log_->clone(name), [this, name](const std::string& why) {
          say(name + " ended: " + why);
          ++counts_["ended_by_itself"];
          burdens_[name].hangs.clear();
          network_.at(network_.now() + kRestart, [this, name] { start_unless_down(name); });
        });
    Process& added = *processes_.emplace_back(std::move(process));
    const auto number = static_cast<int>(processes_.size());
    network_.at(begun_ + number * kBetweenStarts, [this, &added] { start_unless_down(added.name()); });
  }

  Process& find(const std::string& name) {
    return **std::find_if(processes_.begin(), processes_.end(), [&](const auto& p) { return p->name() == name; });
  }

  void plan_faults() {
    std::vector<std::string> services, others;
    for (const auto& process : processes_)
      (process->blueprint().is_world ? others : services).push_back(process->name());
    for (const FaultAction& action : schedule(faults_.plan, services, others, faults_.seed))
      network_.at(begun_ + moment_of(action.t_s), [this, action] { apply(action); });
  }

  /// Counts what changes something, and tells of it.
  void apply(const FaultAction& action) {
    const std::string name = name_of(action.kind);
    if (!carry_out(action) || name.empty()) return;
    ++counts_[name];
    say(name + " " + action.process + (action.to.empty() ? "" : (action.both_ways ? " <-> " : " -> ") + action.to));
  }

  /// False when the site is as it was: another fault has done the same already, or does so still.
  bool carry_out(const FaultAction& action) {
    using Kind = FaultAction::Kind;
    switch (action.kind) {
      case Kind::kLinksChange:
        set_links();
        return true;
      case Kind::kCut:
      case Kind::kHeal:
        return set_cut(action);
      case Kind::kCrash:
        return take_down(find(action.process), action.fault);
      case Kind::kStart:
        bring_up(action.process, action.fault);
        return true;
      case Kind::kHang:
        return begin_hang(find(action.process), action.fault);
      case Kind::kGoOn:
        if (end_of(burdens_[action.process].hangs, action.fault)) find(action.process).hang(false);
        return true;
      case Kind::kClockJump:
        clock_offsets_[action.process] += moment_of(action.by_s);
        network_.set_wall_clock_offset(action.process, clock_offsets_[action.process]);
        return action.by_s != 0.0;
      case Kind::kDiskFull:
        find(action.process).disk().set_full(true);
        return burdens_[action.process].full_disk.insert(action.fault).second &&
               burdens_[action.process].full_disk.size() == 1;
      case Kind::kDiskFree:
        if (end_of(burdens_[action.process].full_disk, action.fault)) find(action.process).disk().set_full(false);
        return true;
      case Kind::kFilesTorn:
      case Kind::kFilesLost:
        return harm_files(find(action.process), action);
      case Kind::kHold:
      case Kind::kLetGo:
      case Kind::kSlow:
      case Kind::kFast:
        return hinder(find(action.process), action);
      case Kind::kDeath:
        return end_for_good(find(action.process), action.fault);
      case Kind::kSignOff:
        return sign_off(find(action.process).blueprint().agv_id);
    }
    return false;
  }

  /// By a person that sees where the vehicle stands.
  bool sign_off(const std::string& agv_id) {
    if (!supervisor_) supervisor_.emplace(network_);
    supervisor_->sign_off(agv_id, recorder_.place_in_map(agv_id));
    return true;
  }

  /// Its body stays in the world, and says nothing to any service.
  bool end_for_good(const Process& vehicle, int fault) {
    const std::string& agv_id = vehicle.blueprint().agv_id;
    for (const auto& process : processes_)
      if (!process->blueprint().is_world && process->blueprint().agv_id == agv_id) take_down(*process, fault);

    dead_.insert(vehicle.name());
    set_links();
    return true;
  }

  /// True when `fault` was the last of `faults`.
  static bool end_of(std::set<int>& faults, int fault) { return faults.erase(fault) > 0 && faults.empty(); }

  /// A process that ends takes its hangs with it.
  bool take_down(Process& process, int fault) {
    const bool was_up = process.is_up();
    process.crash();
    burdens_[process.name()].hangs.clear();
    burdens_[process.name()].downs.insert(fault);
    return was_up;
  }

  void bring_up(const std::string& name, int fault) {
    burdens_[name].downs.erase(fault);
    start_unless_down(name);
  }

  void start_unless_down(const std::string& name) {
    if (burdens_[name].downs.empty()) find(name).start();
  }

  bool begin_hang(Process& process, int fault) {
    if (!process.is_up()) return false;
    std::set<int>& hangs = burdens_[process.name()].hangs;
    hangs.insert(fault);
    process.hang(true);
    return hangs.size() == 1;
  }

  /// Files change while nobody has them open: the host lost its power, and the process with it.
  bool harm_files(Process& process, const FaultAction& action) {
    const bool was_up = take_down(process, action.fault);
    const bool had_files = !process.disk().is_empty();
    if (action.kind == FaultAction::Kind::kFilesTorn) {
      process.disk().tear_files();
    } else {
      process.disk().lose_files();
    }
    network_.at(network_.now() + kRestart, [this, action] { bring_up(action.process, action.fault); });
    return was_up || had_files;
  }

  /// Of a vehicle that several hold, the last one lets it go; shares of its speed are multiplied.
  bool hinder(Process& vehicle, const FaultAction& action) {
    Burden& burden = burdens_[vehicle.name()];
    if (action.kind == FaultAction::Kind::kHold) burden.holds.insert(action.fault);
    if (action.kind == FaultAction::Kind::kLetGo) burden.holds.erase(action.fault);
    if (action.kind == FaultAction::Kind::kSlow) burden.slows[action.fault] = action.share;
    if (action.kind == FaultAction::Kind::kFast) burden.slows.erase(action.fault);

    fake_vehicle::Hindrance& hindrance = hindrances_[vehicle.blueprint().agv_id];
    hindrance.is_held = !burden.holds.empty();
    hindrance.speed_share = 1.0;
    for (const auto& [fault, share] : burden.slows) hindrance.speed_share *= share;

    return true;
  }

  bool set_cut(const FaultAction& action) {
    const bool begins = action.kind == FaultAction::Kind::kCut;
    bool changes = false;
    const auto set = [&](const std::string& from, const std::string& to) {
      int& cuts = cuts_[{from, to}];
      changes = changes || cuts == (begins ? 0 : 1);
      cuts += begins ? 1 : -1;
    };
    set(action.process, action.to);
    if (action.both_ways) set(action.to, action.process);
    set_links();
    return changes;
  }

  /// The laws of nature between the parts of the world are spared, and so is all that the referee hears.
  void set_links() {
    for (const auto& from : processes_) {
      for (const auto& to : processes_) {
        if (from == to || (from->blueprint().is_world && to->blueprint().is_world)) continue;
        network_.set_link(from->name(), to->name(), link_now(from->name(), to->name()));
      }
    }
  }

  Link link_now(const std::string& from, const std::string& to) {
    const LinkFault harm = harm_at(faults_.plan, network_.now() - begun_, from, to);
    Link link = network_.options().link;
    link.latency += of_milliseconds(harm.delay_ms);
    link.jitter += of_milliseconds(harm.jitter_ms);
    link.loss = harm.loss;
    link.duplicate = harm.duplicates;
    link.reorder = harm.reordered;
    if (harm.reordered > 0.0) link.hold_back = of_milliseconds(harm.reorder_ms);
    const auto cut = cuts_.find({from, to});
    link.cut = (cut != cuts_.end() && cut->second > 0) || dead_.count(from) > 0 || dead_.count(to) > 0;
    return link;
  }

  Outcome outcome(const std::string& because) {
    Outcome all;
    all.report = referee_.finish();
    all.report.ended_because = because;
    all.report.scenario = setup_.scenario.name;
    all.report.seed = setup_.seed;
    all.report.person_clearance_m = setup_.scenario.person_clearance_m;
    all.report.people_give_way = setup_.scenario.recordings.empty();
    recorder_.fill(all.result);
    fill_result(all.report, all.result);
    const bus::simulated::Tally& tally = network_.tally();
    all.messages = tally.samples;
    all.faults = counts_;
    const std::pair<const char*, std::uint64_t> packets[] = {{"lost_packets", tally.lost},
                                                             {"delayed_packets", tally.delayed},
                                                             {"duplicated_packets", tally.duplicated},
                                                             {"reordered_packets", tally.reordered},
                                                             {"cut_packets", tally.cut}};
    for (const auto& [name, count] : packets)
      if (count > 0) all.faults[name] = count;
    return all;
  }

  /// The end of the run where no goal was given.
  static double first_goal_s(const referee::RunReport& report) {
    double first_s = report.duration_s;
    for (const referee::GoalRecord& goal : report.goals) first_s = std::min(first_s, goal.assigned_s);
    return first_s;
  }

  static double driven_s(const referee::RunReport& report) {
    double last_s = report.goals_missed() > 0 ? report.duration_s : 0.0;
    for (const referee::GoalRecord& goal : report.goals) last_s = std::max(last_s, goal.decided_s);
    return std::max(0.0, last_s - first_goal_s(report));
  }

  void fill_result(const referee::RunReport& report, Result& result) const {
    result.goals_assigned = report.goals_expected - report.count(referee::GoalOutcome::kCancelled);
    result.goals_reached = report.count(referee::GoalOutcome::kReached);
    result.contacts = static_cast<int>(report.contacts.size());
    result.contacts_moving_vehicle = report.contacts_moving_vehicle();
    result.distance_m = report.distance_m();
    std::map<std::string, int> goals_of = expectation_of(setup_.scenario).goals_of;
    result.least_clearance_m = report.clearances.moving_vehicle_m.value_or(kNothingNearM);
    result.time_s = report.duration_s;
    result.first_goal_s = first_goal_s(report);
    result.driven_s = driven_s(report);
    result.vehicle_hours =
        static_cast<double>(setup_.scenario.vehicles.size()) * (report.duration_s - result.first_goal_s) / 3600.0;
    result.replans = report.replans();
    for (const scenario::Vehicle& vehicle : setup_.scenario.vehicles) {
      int reached = 0;
      double done_s = -1.0;
      for (const referee::GoalRecord& goal : report.goals) {
        if (goal.agv_id != vehicle.id || goal.outcome != referee::GoalOutcome::kReached) continue;
        ++reached;
        done_s = std::max(done_s, goal.decided_s);
      }
      result.reached.push_back(reached);
      result.done_s.push_back(reached >= goals_of[vehicle.id] ? done_s : -1.0);
      const auto row = report.vehicles.find(vehicle.id);
      result.replanned.push_back(row == report.vehicles.end() ? 0 : row->second.replans);
    }
    result.log = report.troubles();
  }

  const Setup& setup_;
  const Faults& faults_;
  const Hooks& hooks_;
  std::shared_ptr<spdlog::logger> log_;
  Network network_;
  time::Stamp begun_;
  referee::Walls walls_;
  std::unique_ptr<bus::simulated::SimulatedBus> referee_bus_;
  service::Shell referee_shell_;
  referee::RefereeService referee_;
  DriveRecorder recorder_;
  std::optional<Spectator> spectator_;
  Hindrances hindrances_;  // before the processes, which read it
  std::vector<std::unique_ptr<Process>> processes_;
  std::map<std::string, nanoseconds> clock_offsets_;
  std::map<std::string, Burden> burdens_;                    // by process
  std::map<std::pair<std::string, std::string>, int> cuts_;  // how many cuts lie on each way now
  std::set<std::string> dead_;                               // the processes that simulate dead vehicles
  std::optional<Supervisor> supervisor_;                     // from the first sign-off on
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace

Outcome drive(const Setup& setup, const Faults& faults, const Hooks& hooks) { return Site(setup, faults, hooks).run(); }

}  // namespace aisle::sim
