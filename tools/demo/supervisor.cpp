#include "tools/demo/supervisor.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <utility>

namespace aisle::demo {
namespace {

constexpr int kTick_ms = 20;
constexpr double kRestart_s = 1.0;
constexpr double kRefereeStop_s = 10.0;  // it writes the report

}  // namespace

Supervisor::Supervisor(std::vector<Process> processes, std::vector<KillOrder> kills,
                       std::filesystem::path program_folder, std::filesystem::path log_folder, Progress& progress)
    : kills_(std::move(kills)),
      program_folder_(std::move(program_folder)),
      log_folder_(std::move(log_folder)),
      progress_(progress),
      started_(std::chrono::steady_clock::now()) {
  for (Process& process : processes) {
    Slot slot;
    slot.start_at_s = process.start_s;
    slot.process = std::move(process);
    slots_.push_back(std::move(slot));
  }

  outcome_.processes = static_cast<int>(slots_.size());
}

double Supervisor::now_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

std::filesystem::path Supervisor::log_of(const Process& process) const {
  return log_folder_ / (process.instance + ".log");
}

/// A loop of short ticks. The referee decides the end: asked to stop, it has kRefereeStop_s for its
/// report.
RunOutcome Supervisor::run(const std::atomic<bool>& stop, double limit_s) {
  double asked_referee_s = -1.0;
  while (!referee_ended()) {
    start_due();
    kill_due();
    wait_for_output();
    drain();
    reap();

    // The run is over, or takes too long: the referee shall write its report.
    if ((stop || now_s() > limit_s) && asked_referee_s < 0.0) {
      asked_referee_s = now_s();
      for (Slot& slot : slots_) {
        if (slot.process.is_referee && slot.child) slot.child->send(SIGTERM);
      }
    }

    if (asked_referee_s >= 0.0 && now_s() - asked_referee_s > kRefereeStop_s) break;
  }

  drain();
  stop_all();

  return outcome_;
}

/// The referee's stdout is piped to us, for the progress.
void Supervisor::start_due() {
  for (Slot& slot : slots_) {
    if (slot.child || slot.start_at_s < 0.0 || now_s() < slot.start_at_s) continue;

    slot.start_at_s = -1.0;
    slot.killed_by_us = false;
    slot.child = std::make_unique<Child>(slot.process, program_folder_ / slot.process.program, log_of(slot.process),
                                         slot.process.is_referee);
  }
}

/// An order may mean several processes; each is killed and started again.
void Supervisor::kill_due() {
  for (auto order = kills_.begin(); order != kills_.end();) {
    if (now_s() < order->at_s) {
      ++order;
      continue;
    }

    for (Slot& slot : slots_) {
      if (!means(order->service, slot.process.instance) || !slot.child) continue;

      progress_.say(fmt::format("{:.1f} s: kill -9 {}, back in {:.1f} s", now_s(), slot.process.instance,
                                order->restart_after_s));
      slot.killed_by_us = true;
      slot.child->send(SIGKILL);
      slot.child.reset();  // reaps it
      slot.start_at_s = now_s() + order->restart_after_s;
      ++outcome_.kills;
    }

    order = kills_.erase(order);
  }
}

void Supervisor::reap() {
  for (Slot& slot : slots_) {
    if (!slot.child) continue;
    if (const std::optional<Ending> ending = slot.child->poll()) died(slot, *ending);
  }
}

/// The referee's end is the end of the run; another process is started again, once.
void Supervisor::died(Slot& slot, const Ending& ending) {
  if (slot.process.is_referee) {
    drain();
    outcome_.referee_code = ending.by_signal ? 1 : ending.code;

    if (ending.by_signal || ending.code > 1) {
      progress_.say(fmt::format("referee ended with {}: {}", ending.text(), last_line(log_of(slot.process))));
    }

    slot.child.reset();
    return;
  }

  ++outcome_.unexpected_deaths;
  ++slot.own_deaths;

  const bool again = slot.own_deaths == 1 && !referee_ended();
  const std::string last_words = last_line(log_of(slot.process));

  outcome_.deaths.push_back({slot.process.instance, ending.text(), last_words, false});
  progress_.say(fmt::format("{:.1f} s: {} ended by itself with {}{}: {}", now_s(), slot.process.instance, ending.text(),
                            again ? ", is restarted" : ", and stays down", last_words));
  slot.child.reset();
  slot.start_at_s = again ? now_s() + kRestart_s : -1.0;
}

bool Supervisor::referee_ended() const {
  return std::any_of(slots_.begin(), slots_.end(),
                     [](const Slot& slot) { return slot.process.is_referee && !slot.child && slot.start_at_s < 0.0; });
}

void Supervisor::wait_for_output() {
  pollfd watched{-1, POLLIN, 0};
  for (const Slot& slot : slots_) {
    if (slot.process.is_referee && slot.child) watched.fd = slot.child->stdout_fd();
  }

  poll(&watched, watched.fd >= 0 ? 1 : 0, kTick_ms);

  if ((watched.revents & POLLHUP) != 0 && (watched.revents & POLLIN) == 0)
    usleep(kTick_ms * 1000);  // closed, not reaped yet
}

/// Hands the referee's whole lines to the progress.
void Supervisor::drain() {
  for (Slot& slot : slots_) {
    if (!slot.process.is_referee || !slot.child) continue;

    char buffer[4096];
    for (ssize_t n = 0; (n = read(slot.child->stdout_fd(), buffer, sizeof buffer)) > 0;) {
      partial_line_.append(buffer, static_cast<std::size_t>(n));
    }
  }

  for (std::size_t end = 0; (end = partial_line_.find('\n')) != std::string::npos;) {
    progress_.referee_line(partial_line_.substr(0, end));
    partial_line_.erase(0, end + 1);
  }
}

/// SIGTERM to all at once, by their ids; what is left after kStop_s is killed.
void Supervisor::stop_all() {
  const double asked_s = now_s();
  for (Slot& slot : slots_) {
    if (slot.child) slot.child->send(SIGTERM);
  }

  // Those that end in time are counted by how they ended.
  for (bool any = true; any && now_s() - asked_s < kStop_s;) {
    any = false;

    for (Slot& slot : slots_) {
      if (!slot.child) continue;

      const std::optional<Ending> ending = slot.child->poll();
      if (!ending) {
        any = true;
        continue;
      }

      outcome_.slowest_stop_s = std::max(outcome_.slowest_stop_s, now_s() - asked_s);

      if (ending->clean()) {
        ++outcome_.stopped_cleanly;
      } else {
        ++outcome_.stopped_uncleanly;
        outcome_.deaths.push_back({slot.process.instance, ending->text(), last_line(log_of(slot.process)), true});
        progress_.say(fmt::format("{} stopped with {}: {}", slot.process.instance, ending->text(),
                                  outcome_.deaths.back().last_words));
      }

      slot.child.reset();
    }

    if (any) poll(nullptr, 0, kTick_ms);
  }

  for (Slot& slot : slots_) {
    if (!slot.child) continue;

    ++outcome_.stopped_uncleanly;
    outcome_.deaths.push_back(
        {slot.process.instance, fmt::format("killed after {:.0f} s", kStop_s), last_line(log_of(slot.process)), true});
    progress_.say(fmt::format("{} did not stop within {:.0f} s, is killed: {}", slot.process.instance, kStop_s,
                              outcome_.deaths.back().last_words));
    slot.child.reset();
  }
}

}  // namespace aisle::demo
