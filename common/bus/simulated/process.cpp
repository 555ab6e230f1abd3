#include "common/bus/simulated/process.hpp"

#include <algorithm>
#include <utility>

#include "common/bus/simulated/core.hpp"

namespace aisle::bus::simulated {

Process::Process(Core& its_core, int its_id, int its_host, const Settings& its_settings)
    : core(its_core), id(its_id), host(its_host), settings(its_settings) {}

void Process::every(std::chrono::nanoseconds period, std::function<void()> handler) {
  timers_.add(period, core.now(), std::move(handler));
  wake_for_timers();
}

void Process::post(std::function<void()> work) {
  posted_.push_back(std::move(work));
  core.give_turn(*this);
}

/// An event at the next tick: it ends a wait, and gives the turn to a process that is driven.
void Process::wake_for_timers() {
  const std::optional<time::Stamp> first = timers_.next();
  if (!first || gone) return;
  if (wake_ && *wake_ <= *first) return;

  wake_ = first;

  core.at(*first, [this, first] {
    if (wake_ != first) return;
    wake_.reset();
    core.give_turn(*this);
  });
}

bool Process::has_work() const {
  if (samples_wait || !posted_.empty() || !incidents.empty()) return true;
  const std::optional<time::Stamp> tick = timers_.next();
  return tick && *tick <= core.now();
}

/// A turn that comes while the last one still takes its time is put off to its end.
void Process::take_turn() {
  if (gone || hung || frozen_since || in_turn_) return;

  if (core.now() < busy_until_) {
    if (!std::exchange(waits_, true)) {
      core.at(busy_until_, [this] {
        waits_ = false;
        core.give_turn(*this);
      });
    }

    return;
  }

  in_turn_ = true;
  busy_until_ = core.now() + turn_time;
  turn ? turn() : static_cast<void>(run_once(std::chrono::nanoseconds(0)));
  in_turn_ = false;
  if (!gone && has_work()) core.give_turn(*this);
}

/// While it waits, the network goes on and other processes have their turns.
bool Process::run_once(std::chrono::nanoseconds limit) {
  const time::Stamp end = core.now() + limit;
  while (!handle_all()) {
    if (gone || core.now() >= end) return false;
    core.wait(end, [this] { return has_work(); });
  }

  return true;
}

/// The same order as in DdsBus.
bool Process::handle_all() {
  if (gone || frozen_since) return false;

  const bool posted_work = handle_posted();
  const bool told_incidents = handle_incidents();
  const bool samples = handle_readers();
  const bool ticks = timers_.handle(core.now());

  wake_for_timers();
  return posted_work || told_incidents || samples || ticks;
}

bool Process::handle_posted() {
  const std::vector<std::function<void()>> work = std::exchange(posted_, {});
  for (const auto& one : work) one();
  return !work.empty();
}

bool Process::handle_incidents() {
  const std::vector<Incident> told = std::exchange(incidents, {});
  for (const Incident& incident : told) report(incident);
  return !told.empty();
}

/// A reader that has more than one turn's samples asks for another turn.
bool Process::handle_readers() {
  if (!std::exchange(samples_wait, false)) return false;

  bool handled = false;
  for (auto& [topic, reader] : readers) {  // a map: readers that a handler adds do not disturb
    handled |= reader->drain([this](const Incident& incident) { report(incident); });
    samples_wait |= reader->has_work();
  }

  return handled;
}

void Process::report(const Incident& incident) const {
  for (const auto& handler : incident_handlers) handler(incident);
}

Announced Process::announce(const SampleCodec& codec, bool is_writer) const {
  const auto other = announced_as.find(codec.topic());

  Announced announced = other == announced_as.end()
                            ? Announced{codec.topic(), codec.type_name(), is_writer, codec.qos(), false}
                            : other->second;

  announced.is_writer = is_writer;
  announced.manual_liveliness = announced.qos.liveliness_lease.count() > 0;

  return announced;
}

std::shared_ptr<WriterEnd> Process::add_writer(const char* topic_name, int strength) {
  Topic& topic = core.topic(topic_name);
  const std::string guid = "p" + std::to_string(id) + ".w" + std::to_string(writers.size());

  writers.push_back(std::make_shared<WriterEnd>(core, *this, topic, announce(topic.codec, true), strength, guid));
  core.introduce(*writers.back());

  return writers.back();
}

ReaderEnd& Process::reader(const char* topic_name) {
  const auto found = readers.find(topic_name);
  if (found != readers.end()) return *found->second;

  Topic& topic = core.topic(topic_name);

  ReaderEnd& made =
      *readers.emplace(topic_name, std::make_unique<ReaderEnd>(core, *this, topic, announce(topic.codec, false)))
           .first->second;

  core.introduce(made);
  return made;
}

void Process::stop() {
  gone = true;
  known.clear();
  for (const auto& writer : writers) writer->stop();
  for (const auto& [topic, reader] : readers) reader->stop();
  timers_.clear();
  posted_.clear();
  incident_handlers.clear();
  held.clear();
  turn = nullptr;
}

std::string Process::described() const {
  return settings.participant_name + " on host " + core.links().host_name(host);
}

std::vector<Endpoint> Process::endpoints() const {
  std::vector<Endpoint> all;

  const auto add = [&](const Announced& seen, const Process& of, bool is_ours) {
    Endpoint endpoint{seen.topic, seen.type, of.settings.participant_name, "", seen.is_writer, seen.qos, {}};
    if (!is_ours) {
      endpoint.host = core.links().host_name(of.host);
      endpoint.qos.depth = 0;
      if (!of.settings.partition.empty()) endpoint.partitions = {of.settings.partition};
    }

    all.push_back(std::move(endpoint));
  };

  // Our own, then those of the processes that we know.
  const auto add_all = [&](const Process& of, bool is_ours) {
    for (const auto& writer : of.writers) {
      if (!writer->gone || of.gone) add(writer->announced, of, is_ours);
    }

    for (const auto& [topic, reader] : of.readers) add(reader->announced, of, is_ours);
  };

  add_all(*this, true);
  for (const int other : known) add_all(core.process(other), false);

  return all;
}

std::vector<Participant> Process::peers() const {
  std::vector<Participant> all;
  for (const int other : known) {
    const Process& peer = core.process(other);
    all.push_back({peer.settings.participant_name, core.links().host_name(peer.host), peer.id + 1});
  }

  return all;
}

}  // namespace aisle::bus::simulated
