// How the processes of a simulated network come to know each other, and forget.

#include <algorithm>

#include "common/bus/simulated/core.hpp"

namespace aisle::bus::simulated {

/// It meets every living process of its domain.
std::shared_ptr<Process> Core::join(const Settings& settings, const std::string& host) {
  auto joined = std::make_shared<Process>(*this, static_cast<int>(processes_.size()), links_.host(host), settings);
  processes_.push_back(joined);

  for (const auto& other : processes_) {
    const bool is_near = !other->gone && other != joined && other->settings.domain == settings.domain;
    if (is_near) meet_soon(*joined, *other, options_.discovery);
  }

  return joined;
}

/// Only one attempt of a pair is under way at any time.
void Core::meet_soon(Process& a, Process& b, time::Stamp delay) {
  const auto pair = std::minmax(a.id, b.id);
  if (!meeting_.insert(pair).second) return;

  after(delay + extra_latency(a, b), [this, &a, &b, pair] {
    meeting_.erase(pair);
    meet(a, b);
  });
}

/// Meeting is mutual: packets must pass both ways.
void Core::meet(Process& a, Process& b) {
  if (a.gone || b.gone) return;
  if (!passes(a, b) || !passes(b, a)) return meet_soon(a, b, options_.announcement);

  a.known.insert(b.id);
  b.known.insert(a.id);
  match_all(a, b);
  match_all(b, a);
}

void Core::match_all(Process& writers, Process& readers) {
  for (const auto& writer : writers.writers) {
    const auto reader = readers.readers.find(writer->announced.topic);
    if (reader != readers.readers.end()) match(*writer, *reader->second);
  }
}

void Core::introduce(WriterEnd& writer) {
  for (const auto& other : processes_) {
    const auto reader = other->readers.find(writer.announced.topic);
    if (reader != other->readers.end()) match_soon(writer, *reader->second);
  }
}

void Core::introduce(ReaderEnd& reader) {
  for (const auto& other : processes_) {
    for (const auto& writer : other->writers) {
      if (writer->announced.topic == reader.announced.topic) match_soon(*writer, reader);
    }
  }
}

/// Within a process at once; to others after the time that an announcement takes.
void Core::match_soon(WriterEnd& writer, ReaderEnd& reader) {
  if (&writer.process == &reader.process) return match(writer, reader);
  if (writer.process.known.count(reader.process.id) == 0) return;  // they match when they meet

  after(options_.matching + extra_latency(writer.process, reader.process), [this, &writer, &reader] {
    const bool passes_both = passes(writer.process, reader.process) && passes(reader.process, writer.process);
    passes_both ? match(writer, reader) : match_soon(writer, reader);
  });
}

/// Three conditions: both processes know each other, they share a partition, and type and QoS fit.
void Core::match(WriterEnd& writer, ReaderEnd& reader) {
  Process& theirs = writer.process;
  Process& ours = reader.process;
  if (writer.gone || reader.gone || theirs.gone || ours.gone) return;

  const bool know_each_other = theirs.known.count(ours.id) > 0 && ours.known.count(theirs.id) > 0;
  if (&theirs != &ours && !know_each_other) return;
  if (!same_partition(theirs.settings.partition, {ours.settings.partition}) || !fit(writer, reader)) return;

  // A connection made before is renewed.
  const auto known = std::find_if(writer.matches.begin(), writer.matches.end(),
                                  [&](const Match* match) { return &match->reader == &reader; });
  if (known != writer.matches.end()) return establish(**known);

  Match& made = *matches_.emplace_back(std::make_unique<Match>(writer, reader));
  const auto is = [&](auto Qos::*policy, auto value) {
    return writer.announced.qos.*policy == value && reader.announced.qos.*policy == value;
  };

  made.reliable = is(&Qos::reliability, Reliability::kReliable);
  made.transient_local = is(&Qos::durability, Durability::kTransientLocal);
  writer.matches.push_back(&made);
  reader.matches.push_back(&made);
  establish(made);
}

/// The reader's process is told first, then the writer's, as each sees it.
bool Core::fit(WriterEnd& writer, ReaderEnd& reader) {
  const auto seen_by_reader = mismatch(reader.announced, writer.announced, writer.process.described());
  if (!seen_by_reader) return true;
  if (!refused_.emplace(&writer, &reader).second) return false;

  reader.process.incidents.push_back(*seen_by_reader);
  give_turn(reader.process);

  if (&writer.process == &reader.process) return false;

  const auto seen_by_writer = mismatch(writer.announced, reader.announced, reader.process.described());
  if (seen_by_writer) writer.process.incidents.push_back(*seen_by_writer);
  give_turn(writer.process);

  return false;
}

/// Each side that does not know the other (any more) begins anew. Where only the reader forgot, the writer says again
/// what it still owes.
void Core::establish(Match& match) {
  const bool was_whole = match.at_reader && match.at_writer;
  if (was_whole) return;
  if (!match.at_reader) match.reader.begin(match);
  match.writer.begin_stream(match);
}

/// It tries to meet the other again, in case the silence ends.
void Core::forget(Process& forgetful, Process& other) {
  if (forgetful.gone || forgetful.known.erase(other.id) == 0) return;

  for (const auto& match : matches_) {
    if (&match->reader.process == &forgetful && &match->writer.process == &other) match->reader.forget(*match);
    if (&match->writer.process == &forgetful && &match->reader.process == &other) match->writer.forget(*match);
  }

  if (!other.gone) meet_soon(forgetful, other, options_.announcement);
}

/// Those that are told forget it at once; the others after its lease.
void Core::leave(Process& process) {
  if (process.gone) return;

  for (const int id : process.known) {
    Process& other = *processes_[static_cast<std::size_t>(id)];
    tell(process, other, [this, &other, &process] { forget(other, process); });
  }

  fall_silent(process);
}

void Core::crash(Process& process) {
  if (process.gone) return;
  process.crashed = true;
  fall_silent(process);
}

/// Others that are not told forget it after its lease.
void Core::fall_silent(Process& process) {
  process.gone_at = now_;
  process.stop();

  for (const auto& other : processes_) {
    if (other->known.count(process.id) > 0) forget_when_still(*other, process, now_);
  }
}

/// Packets that came meanwhile are taken when it continues.
void Core::freeze(Process& process, bool frozen) {
  if (process.gone || frozen == process.frozen_since.has_value()) return;

  if (frozen) {
    process.frozen_since = now_;

    for (const auto& other : processes_) {
      if (other->known.count(process.id) > 0) forget_when_still(*other, process, now_);
    }

    return;
  }

  process.frozen_since.reset();
  process.held_bytes = 0;
  for (const auto& packet : std::exchange(process.held, {})) packet();
  give_turn(process);
}

void Core::set_link(const std::string& from, const std::string& to, const Link& link) {
  links_.set_link(links_.host(from), links_.host(to), link, now_);
  watch_cuts();
}

void Core::set_all_links(const Link& link) {
  links_.set_all_between(link, now_);
  watch_cuts();
}

/// Since when `listener` has not been able to hear `speaker`; empty when it can.
std::optional<time::Stamp> Core::silent_since(const Process& speaker, const Process& listener) const {
  std::optional<time::Stamp> since = links_.cut_since(speaker.host, listener.host);
  for (const std::optional<time::Stamp>& other : {speaker.frozen_since, speaker.gone_at}) {
    if (other && (!since || *other < *since)) since = other;
  }

  return since;
}

/// Begins a lease for each pair whose link was cut at this moment.
void Core::watch_cuts() {
  for (const auto& listener : processes_) {
    for (const int id : listener->known) {
      Process& speaker = *processes_[static_cast<std::size_t>(id)];
      const auto since = links_.cut_since(speaker.host, listener->host);
      if (since && *since == now_) forget_when_still(*listener, speaker, now_);
    }
  }
}

void Core::forget_when_still(Process& forgetful, Process& other, time::Stamp silent) {
  at(silent + options_.participant_lease, [this, &forgetful, &other, silent] {
    const std::optional<time::Stamp> since = silent_since(other, forgetful);
    if (since && *since <= silent) forget(forgetful, other);
  });
}

}  // namespace aisle::bus::simulated
