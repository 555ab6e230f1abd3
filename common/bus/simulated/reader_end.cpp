#include <algorithm>

#include "common/bus/simulated/core.hpp"

namespace aisle::bus::simulated {
namespace {

constexpr int kSamplesPerTurn = 512;  // then others have their turn

/// The sample of a change, decoded once for all its readers; null when the bytes are no such sample.
const void* sample_of(const Change& change, const SampleCodec& codec) {
  if (!change.decoded) {
    change.decoded = codec.new_sample();
    change.is_malformed = !codec.decode(change.bytes, change.decoded.get());
  }

  return change.is_malformed ? nullptr : change.decoded.get();
}

}  // namespace

ReaderEnd::ReaderEnd(Core& core, Process& its_process, Topic& its_topic, Announced its_announced)
    : process(its_process), topic(its_topic), announced(std::move(its_announced)), core_(core), qos_(announced.qos) {}

int ReaderEnd::matched_writers() const {
  return static_cast<int>(std::count_if(matches.begin(), matches.end(), [](const Match* m) { return m->at_reader; }));
}

void ReaderEnd::begin(Match& match) {
  match.at_reader = true;
  match.newest = 0;
  match.heard_stream = 0;
  match.alive = true;
}

void ReaderEnd::forget(Match& match) {
  if (!match.at_reader) return;

  match.at_reader = false;
  match.early.clear();
  lose_ownership(match.writer);
  note({&match.writer, true, false});
}

void ReaderEnd::stop() {
  gone = true;
  waiting_.clear();
  events_.clear();
  handlers_.clear();
}

void ReaderEnd::wake() {
  process.samples_wait = true;
  core_.give_turn(process);
}

void ReaderEnd::note(const WriterEvent& event) {
  if (gone) return;
  events_.push_back(event);
  wake();
}

/// A sample has arrived: renews the lease, then passes the filters for duplicates and for
/// ownership.
void ReaderEnd::accept(Match& match, const ChangePtr& change) {
  if (gone) return;

  assert_liveliness(match);

  if (change->sequence <= match.newest) return;  // twice, or overtaken

  match.newest = change->sequence;

  if (qos_.ownership == Ownership::kExclusive && !is_owner(match.writer, change->instance)) return;

  if (qos_.deadline.count() > 0) {
    deadlines_[change->instance] = core_.now() + qos_.deadline;
    watch_deadlines();
  }

  put(change, match.writer);
}

/// Keep last: the oldest waiting sample of the instance makes room.
void ReaderEnd::put(const ChangePtr& change, WriterEnd& writer) {
  const InstanceId& instance = change->instance;
  const auto begin = std::lower_bound(waiting_.begin(), waiting_.end(), instance,
                                      [](const Cached& other, const InstanceId& id) { return id < other.instance(); });
  const auto end = std::find_if(begin, waiting_.end(), [&](const Cached& c) { return !(c.instance() == instance); });

  const auto place = std::distance(waiting_.begin(), begin);
  if (qos_.depth > 0 && std::distance(begin, end) >= qos_.depth) waiting_.erase(std::prev(end));
  waiting_.insert(waiting_.begin() + place, {change, &writer});
  wake();
}

/// The strongest writer; of equally strong ones the one with the least id.
bool ReaderEnd::is_owner(const WriterEnd& writer, const InstanceId& instance) {
  std::vector<const WriterEnd*>& claims = claims_[instance];
  if (std::find(claims.begin(), claims.end(), &writer) == claims.end()) claims.push_back(&writer);

  return std::none_of(claims.begin(), claims.end(), [&](const WriterEnd* other) {
    if (other->strength != writer.strength) return other->strength > writer.strength;
    return std::pair(other->process.id, other->guid) < std::pair(writer.process.id, writer.guid);
  });
}

void ReaderEnd::lose_ownership(const WriterEnd& writer) {
  for (auto& [instance, claims] : claims_)
    claims.erase(std::remove(claims.begin(), claims.end(), &writer), claims.end());
}

/// A writer that was silent beyond its lease is alive again.
void ReaderEnd::assert_liveliness(Match& match) {
  if (gone || qos_.liveliness_lease.count() == 0) return;

  match.asserted = core_.now();

  if (!match.alive) {
    match.alive = true;
    note({&match.writer, false, false});
  }

  if (!match.lease_watched) watch_lease(match);
}

/// One event for each lease: it looks again if the writer spoke meanwhile.
void ReaderEnd::watch_lease(Match& match) {
  match.lease_watched = true;

  core_.at(match.asserted + qos_.liveliness_lease, [this, &match] {
    match.lease_watched = false;

    if (gone || !match.at_reader) return;
    if (match.asserted + qos_.liveliness_lease > core_.now()) return watch_lease(match);

    match.alive = false;
    lose_ownership(match.writer);
    note({&match.writer, true, true});
  });
}

void ReaderEnd::watch_deadlines() {
  if (deadlines_watched_ || deadlines_.empty()) return;

  deadlines_watched_ = true;

  const auto first = std::min_element(deadlines_.begin(), deadlines_.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  core_.at(first->second, [this] { check_deadlines(); });
}

/// A missed deadline begins the next one; the loop reports how many were missed.
void ReaderEnd::check_deadlines() {
  deadlines_watched_ = false;

  if (gone) return;

  for (auto& [instance, due] : deadlines_) {
    if (due > core_.now()) continue;

    due = core_.now() + qos_.deadline;
    ++missed_;

    // The owner lost this instance, until it writes again.
    if (qos_.ownership == Ownership::kExclusive) claims_[instance].clear();
  }

  if (missed_ > 0) wake();
  watch_deadlines();
}

/// Samples first, then the ends of writers that did not come back, then missed deadlines.
bool ReaderEnd::drain(const Report& report) {
  if (!has_work()) return false;

  // Taken before the samples, handled after them: what a writer said last comes before its end.
  const std::vector<WriterEvent> events = std::exchange(events_, {});
  bool handled = drain_samples(report);

  for (std::size_t i = 0; i < events.size(); ++i) {
    const bool returned =
        std::any_of(events.begin() + static_cast<std::ptrdiff_t>(i), events.end(),
                    [&](const WriterEvent& later) { return later.writer == events[i].writer && !later.gone; });
    if (events[i].gone && !returned) lose(events[i], report);
    handled = true;
  }

  if (missed_ > 0) {
    missed_total_ += std::exchange(missed_, 0);
    const Incident incident = deadline_missed(topic.codec.topic(), qos_, missed_total_);
    if (quiet_.allows(incident.kind, core_.now())) report(incident);
  }

  return handled;
}

/// Instance by instance in the order of their hashes, as Fast DDS does.
bool ReaderEnd::drain_samples(const Report& report) {
  int taken = 0;
  for (; taken < kSamplesPerTurn && !waiting_.empty(); ++taken) {
    const Cached next = std::move(waiting_.back());
    waiting_.pop_back();
    take(next, report);
  }

  return taken > 0;
}

/// The same steps as TopicReader::take.
void ReaderEnd::take(const Cached& cached, const Report& report) {
  const Change& change = *cached.change;
  if (change.disposed) {
    end(change.instance, *cached.writer, true);
    return;
  }

  const void* sample = sample_of(change, topic.codec);
  if (sample == nullptr) {
    report(malformed_sample(topic.codec.topic(), announced.type, cached.writer->process.described()));
    return;
  }

  if (qos_.depth > 0) {
    instances_.hear(change.instance, cached.writer, [&] {
      AnySample key = topic.codec.new_sample();
      topic.codec.copy_key(key.get(), sample);
      return key;
    });
  }

  hand_over(sample, SampleKind::kData, *cached.writer);
}

void ReaderEnd::end(const InstanceId& instance, const WriterEnd& writer, bool disposed) {
  const auto key = instances_.end(instance, &writer, disposed);
  if (!key) return;
  deadlines_.erase(instance);
  hand_over(key->get(), disposed ? SampleKind::kDisposed : SampleKind::kNoWriters, writer);
}

void ReaderEnd::lose(const WriterEvent& event, const Report& report) {
  if (event.silent) report(liveliness_lost(topic.codec.topic(), qos_, event.writer->process.described()));
  for (const InstanceId& instance : instances_.heard_from(event.writer)) end(instance, *event.writer, false);
}

void ReaderEnd::hand_over(const void* sample, SampleKind kind, const WriterEnd& writer) {
  ++core_.links().tally().samples;
  const SampleInfo info{kind, writer.guid, core_.now()};
  for (std::size_t i = 0; i < handlers_.size(); ++i) handlers_[i](sample, info);  // a handler may add handlers
}

}  // namespace aisle::bus::simulated
