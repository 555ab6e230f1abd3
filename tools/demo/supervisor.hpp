#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tools/demo/child.hpp"
#include "tools/demo/orders.hpp"
#include "tools/demo/progress.hpp"

namespace aisle::demo {

/// A process that ended without being asked, or not as it was asked.
struct Death {
  std::string instance;
  std::string ending;      // "signal 6", "exit code 3", "killed after 2 s"
  std::string last_words;  // the last line of its log
  bool while_stopping{false};
};

/// What became of a run's processes; the referee's report tells the rest.
struct RunOutcome {
  int referee_code{1};
  int processes{0};
  int kills{0};
  int unexpected_deaths{0};
  int stopped_cleanly{0};  // within kStop_s after SIGTERM, exit code 0
  int stopped_uncleanly{0};
  double slowest_stop_s{0.0};
  std::vector<Death> deaths;
};

/// Runs the processes of one fleet: starts them in order, kills and restarts as ordered, restarts once
/// a process that dies by itself, and stops all when the referee has ended.
class Supervisor {
 public:
  /// Programs are started from `program_folder`; each writes to `<log_folder>/<instance>.log`.
  Supervisor(std::vector<Process> processes, std::vector<KillOrder> kills, std::filesystem::path program_folder,
             std::filesystem::path log_folder, Progress& progress);

  /// Runs until the referee ends, `stop` becomes true (then the referee is asked to end), or `limit_s`
  /// seconds have passed.
  RunOutcome run(const std::atomic<bool>& stop, double limit_s);

  static constexpr double kStop_s = 2.0;

 private:
  /// A process of the run, running or not.
  struct Slot {
    Process process;
    std::unique_ptr<Child> child;  // null: not running
    double start_at_s{0.0};        // while not running: when it starts; less than 0: never
    int own_deaths{0};
    bool killed_by_us{false};
  };

  /// Seconds since the supervisor was made.
  double now_s() const;
  std::filesystem::path log_of(const Process& process) const;

  /// Starts, kills, and looks after what is due now.
  void start_due();
  void kill_due();
  void reap();

  /// A process ended by itself: notes its last words and restarts it once.
  void died(Slot& slot, const Ending& ending);

  /// Does it run no more, and is not about to start?
  bool referee_ended() const;

  /// Until the referee writes a line, at most one tick.
  void wait_for_output();

  /// Reads what the referee has written.
  void drain();
  void stop_all();

  std::vector<Slot> slots_;
  std::vector<KillOrder> kills_;  // those still to come
  std::filesystem::path program_folder_;
  std::filesystem::path log_folder_;
  Progress& progress_;
  std::chrono::steady_clock::time_point started_;
  std::string partial_line_;
  RunOutcome outcome_;
};

}  // namespace aisle::demo
