#include "common/bus/dds/dds_bus.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <mutex>
#include <utility>

#include "common/bus/dds/host_clock.hpp"
#include "common/bus/dds/site.hpp"
#include "common/bus/dds/topic_reader.hpp"
#include "common/bus/timers.hpp"

namespace aisle::bus {

/// The loop: it waits on a WaitSet until a reader has something, a timer is due, or the guard condition
/// wakes it; then it handles everything that has come.
struct DdsBus::State {
  explicit State(const Settings& given) : settings(given), site(std::make_shared<Site>(given)) {
    wait_set.attach_condition(site->guard());
  }

  ~State() {
    for (auto& [name, reader] : readers) wait_set.detach_condition(reader->condition());
    wait_set.detach_condition(site->guard());
  }

  bool handle_posted();
  bool handle_incidents();
  bool handle_readers();
  bool handle_all();

  /// Until `limit`, or the next timer if that is earlier. Not at all when a reader has more.
  void wait_until(time::Stamp limit);

  void report(const Incident& incident) const {
    for (const auto& handler : incident_handlers) handler(incident);
  }

  Settings settings;
  std::shared_ptr<Site> site;
  fast::dds::WaitSet wait_set;
  std::map<std::string, std::unique_ptr<TopicReader>> readers;  // by topic
  Timers timers;
  std::deque<std::function<void(const Incident&)>> incident_handlers;
  std::vector<Endpoint> own;
  std::mutex post_mutex;
  std::vector<std::function<void()>> posted;
};

/// Taken out under the lock and run without it: work may post again.
bool DdsBus::State::handle_posted() {
  std::vector<std::function<void()>> work;
  {
    const std::lock_guard<std::mutex> lock(post_mutex);
    work.swap(posted);
  }

  for (const auto& one : work) one();
  return !work.empty();
}

bool DdsBus::State::handle_incidents() {
  const std::vector<Incident> conflicts = site->discovery().new_conflicts();
  for (const Incident& incident : conflicts) report(incident);
  return !conflicts.empty();
}

bool DdsBus::State::handle_readers() {
  bool handled = false;
  for (auto& [name, reader] : readers) {  // a map: readers that a handler adds do not disturb
    handled |= reader->drain([this](const Incident& incident) { report(incident); });
  }

  return handled;
}

/// Posted work first, timers last; each kind gets its turn.
bool DdsBus::State::handle_all() {
  site->guard().set_trigger_value(false);  // first: what comes from now on wakes the next wait

  const bool posted_work = handle_posted();
  const bool incidents = handle_incidents();
  const bool samples = handle_readers();
  const bool ticks = timers.handle(monotonic_now());

  return posted_work || incidents || samples || ticks;
}

void DdsBus::State::wait_until(time::Stamp limit) {
  for (const auto& [name, reader] : readers) {
    if (reader->has_more()) return;
  }

  if (const auto tick = timers.next()) limit = std::min(limit, *tick);

  const auto left = limit - monotonic_now();
  if (left <= std::chrono::nanoseconds(0)) return;

  fast::dds::ConditionSeq active;
  wait_set.wait(active, fast::duration(left));
}

DdsBus::DdsBus(const Settings& settings) : state_(std::make_unique<State>(settings)) {}
DdsBus::~DdsBus() = default;

std::shared_ptr<detail::RawWriter> DdsBus::raw_writer(const char* topic, int strength) {
  const Site::Channel& channel = state_->site->channel(topic);
  auto writer = std::make_shared<DdsWriter>(state_->site, channel, strength);

  state_->own.push_back(
      {topic, channel.support.get_type_name(), state_->settings.participant_name, "", true, channel.type->qos, {}});
  return writer;
}

/// Handlers of one topic share the reader that the first one makes.
void DdsBus::raw_on(const char* topic, detail::RawHandler handler) {
  auto found = state_->readers.find(topic);
  if (found == state_->readers.end()) {
    const Site::Channel& channel = state_->site->channel(topic);
    found = state_->readers.emplace(topic, std::make_unique<TopicReader>(*state_->site, channel)).first;
    state_->wait_set.attach_condition(found->second->condition());
    state_->own.push_back(
        {topic, channel.support.get_type_name(), state_->settings.participant_name, "", false, channel.type->qos, {}});
  }

  found->second->add(std::move(handler));
}

void DdsBus::every(std::chrono::nanoseconds period, std::function<void()> handler) {
  state_->timers.add(period, monotonic_now(), std::move(handler));
}

void DdsBus::on_incident(std::function<void(const Incident&)> handler) {
  state_->incident_handlers.push_back(std::move(handler));
}

void DdsBus::post(std::function<void()> work) {
  {
    const std::lock_guard<std::mutex> lock(state_->post_mutex);
    state_->posted.push_back(std::move(work));
  }

  state_->site->wake();
}

/// Again until something was handled or the time is over: a wait may end for nothing.
bool DdsBus::run_once(std::chrono::nanoseconds limit) {
  const time::Stamp end = monotonic_now() + limit;
  while (!state_->handle_all()) {
    if (monotonic_now() >= end) return false;
    state_->wait_until(end);
  }

  return true;
}

time::Stamp DdsBus::now() const { return monotonic_now(); }

std::int64_t DdsBus::wall_clock_ns() const {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_epoch).count();
}

int DdsBus::matched_writers(const std::string& topic) const {
  const auto found = state_->readers.find(topic);
  return found == state_->readers.end() ? 0 : found->second->matched_writers();
}

std::vector<Endpoint> DdsBus::endpoints() const {
  std::vector<Endpoint> all = state_->own;
  for (Endpoint& endpoint : state_->site->discovery().endpoints()) all.push_back(std::move(endpoint));
  return all;
}

std::vector<Participant> DdsBus::peers() const { return state_->site->discovery().participants(); }

const Settings& DdsBus::settings() const { return state_->settings; }

}  // namespace aisle::bus
