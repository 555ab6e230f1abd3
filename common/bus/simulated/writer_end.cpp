#include <algorithm>

#include "common/bus/simulated/core.hpp"

namespace aisle::bus::simulated {
namespace {

/// A message is not sent again sooner, however often it is asked for.
constexpr time::Stamp kResendAfter = std::chrono::milliseconds(10);
constexpr std::size_t kProtocolBytes = 100;  // of a heartbeat, an acknowledgement, an assertion

}  // namespace

/// FNV-1a, 64 bit.
InstanceId Topic::instance_of(const void* sample) {
  codec.key(sample, key_);

  InstanceId instance{14695981039346656037U, -1};
  for (const char c : key_) instance.hash = (instance.hash ^ static_cast<unsigned char>(c)) * 1099511628211U;

  if (codec.qos().depth == 0) return instance;

  instance.number = instances_.try_emplace(key_, static_cast<int>(instances_.size())).first->second;
  return instance;
}

WriterEnd::WriterEnd(Core& core, Process& its_process, Topic& its_topic, Announced its_announced, int its_strength,
                     std::string its_guid)
    : process(its_process),
      topic(its_topic),
      announced(std::move(its_announced)),
      strength(announced.qos.ownership == Ownership::kExclusive ? std::max(0, its_strength) : 0),
      guid(std::move(its_guid)),
      core_(core) {}

bool WriterEnd::write(const void* sample) {
  if (gone) return false;  // its topic may be gone too

  const InstanceId instance = topic.instance_of(sample);
  if (!say(sample, instance, false)) return false;

  if (instance.number >= 0) written_.insert(instance);
  return true;
}

bool WriterEnd::dispose(const void* sample) {
  if (gone) return false;
  const InstanceId instance = topic.instance_of(sample);
  if (written_.erase(instance) == 0) return false;
  return say(sample, instance, true);
}

/// Nothing is kept or sent when the sample cannot be encoded.
bool WriterEnd::say(const void* sample, const InstanceId& instance, bool disposed) {
  end_acknowledged();

  if (is_full()) return false;

  auto change = std::make_shared<Change>(Change{sequence_ + 1, instance, disposed, {}});
  if (!topic.codec.encode(sample, change->bytes)) return false;

  ++sequence_;
  ++unended_;
  keep(change);
  publish(change);

  return true;
}

/// Best effort: readers that a packet reaches at the same time share an event.
void WriterEnd::publish(const ChangePtr& change) {
  std::vector<std::pair<time::Stamp, std::vector<Match*>>> arrivals;
  for (Match* match : matches) {
    if (!match->at_writer) continue;

    if (match->reliable) {
      send(*match, change);
      continue;
    }

    const Links::Fate fate = core_.links().send(process.host, match->reader.process.host);
    for (int i = 0; i < fate.copies; ++i) {
      const auto same = std::find_if(arrivals.begin(), arrivals.end(),
                                     [&](const auto& arrival) { return arrival.first == fate.after[i]; });
      if (same == arrivals.end()) {
        arrivals.push_back({fate.after[i], {match}});
      } else {
        same->second.push_back(match);
      }
    }
  }

  // One event for all readers that it reaches at the same time.
  for (auto& [after, reached] : arrivals) {
    core_.after(after, [this, reached = std::move(reached), change] {
      for (Match* match : reached) {
        core_.take_in(match->reader.process, change->bytes.size(), [match, change] {
          if (match->at_reader) match->reader.accept(*match, change);
        });
      }
    });
  }
}

void WriterEnd::end_acknowledged() {
  if (is_acknowledged()) unended_ = 0;
}

/// Queues are bounded by what was written since all readers had acknowledged all of it, as DdsWriter bounds them.
bool WriterEnd::is_full() const {
  if (announced.qos.depth > 0 || announced.qos.reliability != Reliability::kReliable) return false;
  return unended_ >= announced.qos.max_kept;
}

/// A disposal ends what is kept of the instance: late joiners do not hear of it.
void WriterEnd::keep(const ChangePtr& change) {
  if (announced.qos.durability != Durability::kTransientLocal) return;

  if (change->disposed) {
    kept_.erase(change->instance);
    return;
  }

  std::deque<ChangePtr>& kept = kept_[change->instance];
  kept.push_back(change);
  if (kept.size() > static_cast<std::size_t>(std::max(1, announced.qos.depth))) kept.pop_front();
}

/// A message that was replaced keeps its number, empty, so that the reader does not wait for it.
void WriterEnd::send(Match& match, const ChangePtr& change) {
  // Keep last 1: unacknowledged changes of this instance are replaced. (All our topics keep 1, or everything.)
  if (announced.qos.depth > 0) {
    for (auto& [number, message] : match.unacknowledged) {
      if (message.change && message.change->instance == change->instance) message.change = nullptr;
    }
  }

  const std::uint64_t number = match.next++;
  match.unacknowledged[number].change = change;
  transmit(match, number);
  begin_heartbeats(match);
}

/// On arrival the reader's side of the stream is put in order: messages behind a missing one wait in
/// `early`, those that are next are handed over. A higher stream than before: the writer began anew.
void WriterEnd::transmit(Match& match, std::uint64_t number) {
  Match::Message& message = match.unacknowledged.at(number);
  message.sent = core_.now();

  const auto arrival = [this, &match, stream = match.stream, number, last = match.next - 1, change = message.change] {
    ReaderEnd& reader = match.reader;
    if (!match.at_reader || stream < match.heard_stream) return;

    if (stream > match.heard_stream) {
      match.heard_stream = stream;
      match.expected = 1;
      match.announced = 0;
      match.early.clear();
    }

    // Early ones wait; those that are next go on.
    match.announced = std::max(match.announced, last);
    if (number >= match.expected) match.early.emplace(number, change);

    while (!match.early.empty() && match.early.begin()->first == match.expected) {
      const ChangePtr next = match.early.begin()->second;
      match.early.erase(match.early.begin());
      ++match.expected;
      if (next) reader.accept(match, next);
    }

    answer(match);
  };

  core_.send(process, match.reader.process, message.change ? message.change->bytes.size() : kProtocolBytes, arrival);
}

/// The reader says what it has, and what it misses of what it knows to be there.
void WriterEnd::answer(Match& match) {
  std::vector<std::uint64_t> missing;
  for (std::uint64_t number = match.expected; number <= match.announced; ++number) {
    if (match.early.count(number) == 0) missing.push_back(number);
  }

  core_.send(match.reader.process, process, kProtocolBytes,
             [this, &match, stream = match.heard_stream, expected = match.expected, missing = std::move(missing)] {
               acknowledged(match, stream, expected, missing);
             });
}

/// Everything below `expected` has arrived; the missing ones are sent again.
void WriterEnd::acknowledged(Match& match, std::uint64_t stream, std::uint64_t expected,
                             const std::vector<std::uint64_t>& missing) {
  if (gone || !match.at_writer || stream != match.stream) return;

  match.unacknowledged.erase(match.unacknowledged.begin(), match.unacknowledged.lower_bound(expected));

  for (const std::uint64_t number : missing) {
    const auto found = match.unacknowledged.find(number);
    if (found == match.unacknowledged.end() || core_.now() - found->second.sent < kResendAfter) continue;
    ++core_.links().tally().resent;
    transmit(match, number);
  }
}

void WriterEnd::begin_heartbeats(Match& match) {
  if (match.heartbeats) return;
  match.heartbeats = true;
  core_.after(core_.options().heartbeat, [this, &match] { heartbeat(match); });
}

/// Tells the reader the last number, so that it notices a loss at the end of the stream.
void WriterEnd::heartbeat(Match& match) {
  match.heartbeats = false;

  if (gone || !match.at_writer || match.unacknowledged.empty()) return;

  if (!process.frozen_since) {
    core_.send(process, match.reader.process, kProtocolBytes,
               [this, &match, stream = match.stream, last = match.next - 1] {
                 if (!match.at_reader || stream < match.heard_stream) return;

                 if (stream == match.heard_stream) {
                   match.announced = std::max(match.announced, last);
                 } else {
                   match.heard_stream = stream;
                   match.expected = 1;
                   match.announced = last;
                   match.early.clear();
                 }

                 answer(match);
               });
  }

  begin_heartbeats(match);
}

/// With a heartbeat, which best-effort writers have none of.
void WriterEnd::assert_liveliness() {
  if (gone || announced.qos.liveliness_lease.count() == 0) return;

  for (Match* match : matches) {
    if (!match->at_writer || !match->reliable) continue;
    core_.send(process, match->reader.process, kProtocolBytes, [match] {
      if (match->at_reader) match->reader.assert_liveliness(*match);
    });
  }
}

int WriterEnd::matched_readers() const {
  if (gone) return 0;
  return static_cast<int>(std::count_if(matches.begin(), matches.end(), [](const Match* m) { return m->at_writer; }));
}

bool WriterEnd::is_acknowledged() const {
  return !gone && std::all_of(matches.begin(), matches.end(), [](const Match* m) { return m->unacknowledged.empty(); });
}

/// Owed are messages that were not acknowledged, and for late joiners what is kept; in the order of
/// writing, each once.
void WriterEnd::begin_stream(Match& match) {
  std::map<std::uint64_t, ChangePtr> owed;  // by the writer's sequence
  for (const auto& [number, message] : match.unacknowledged) {
    if (message.change) owed.emplace(message.change->sequence, message.change);
  }

  if (match.transient_local) {
    for (const auto& [instance, kept] : kept_) {
      for (const ChangePtr& change : kept) owed.emplace(change->sequence, change);
    }
  }

  match.at_writer = true;
  ++match.stream;
  match.next = 1;
  match.unacknowledged.clear();

  if (!match.reliable) return;  // best effort: only what comes from now on

  for (const auto& [sequence, change] : owed) send(match, change);
}

void WriterEnd::forget(Match& match) {
  match.at_writer = false;
  match.unacknowledged.clear();
}

/// Readers are told reliably; until they hear it they take what is under way.
void WriterEnd::close() {
  if (gone) return;

  gone = true;

  for (Match* match : matches) {
    forget(*match);
    if (!match->at_reader) continue;
    core_.tell(process, match->reader.process, [match] { match->reader.forget(*match); });
  }

  kept_.clear();
}

void WriterEnd::stop() {
  gone = true;
  kept_.clear();
}

}  // namespace aisle::bus::simulated
