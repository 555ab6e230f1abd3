#include "common/bus/simulated/core.hpp"

#include <algorithm>
#include <cassert>

namespace aisle::bus::simulated {

Core::Core(std::uint64_t seed, const Options& options)
    : options_(options), now_(options.start), links_(seed, options.link) {}

/// Events that an event adds for the same moment belong to this step.
bool Core::step() {
  if (is_idle()) return false;

  now_ = next_time();
  while (!events_.empty() && events_.next_time() <= now_) events_.pop()();
  give_turns();

  return true;
}

void Core::advance_to(time::Stamp time) {
  while (!is_idle() && next_time() <= time) step();
  now_ = std::max(now_, time);
}

/// Called by a bus within its turn: other buses have their turns meanwhile.
bool Core::wait(time::Stamp limit, const std::function<bool()>& done) {
  while (!done()) {
    if (is_idle() || next_time() > limit) {
      now_ = std::max(now_, limit);
      return done();
    }

    step();
  }

  return true;
}

void Core::give_turns() {
  const std::set<int> ready = std::exchange(ready_, {});
  for (const int id : ready) {
    const std::shared_ptr<Process> process = processes_[static_cast<std::size_t>(id)];
    process->take_turn();
  }
}

bool Core::passes(const Process& from, const Process& to) const {
  return !from.frozen_since && !to.frozen_since && !links_.link(from.host, to.host).passes_nothing();
}

time::Stamp Core::extra_latency(const Process& a, const Process& b) const {
  const time::Stamp slower = std::max(links_.link(a.host, b.host).latency, links_.link(b.host, a.host).latency);
  return std::max(time::Stamp{}, slower - options_.link.latency);
}

/// A packet that is lost, or cannot pass, is tried again a heartbeat later.
void Core::tell(Process& from, Process& to, std::function<void()> arrival) {
  if (to.gone) return;

  const Links::Fate fate = passes(from, to) ? links_.send(from.host, to.host) : Links::Fate{};
  if (fate.copies == 0) {
    after(options_.heartbeat, [this, &from, &to, arrival = std::move(arrival)] {
      if (!from.gone) tell(from, to, arrival);
    });

    return;
  }

  after(fate.after[0], [&to, arrival = std::move(arrival)] {
    if (!to.gone) arrival();
  });
}

Topic& Core::topic(const char* name) {
  const auto found = topics_.find(name);
  return found != topics_.end() ? found->second : topics_.try_emplace(name, sample_codec(name)).first->second;
}

std::int64_t Core::wall_clock_ns(int host) const {
  const auto offset = wall_offsets_.find(host);
  return options_.wall_clock_start_ns + (now_ - options_.start).count() +
         (offset == wall_offsets_.end() ? 0 : offset->second.count());
}

}  // namespace aisle::bus::simulated
