#include "common/bus/dds/topic_reader.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "common/bus/dds/host_clock.hpp"

namespace aisle::bus {
namespace {

namespace dds = fast::dds;
constexpr int kSamplesPerTurn = 512;  // then others have their turn

/// As Fast DDS prints it.
std::string text_of_guid(const fast::rtps::InstanceHandle_t& writer) {
  std::ostringstream text;
  text << fast::rtps::iHandle2GUID(writer);
  return text.str();
}

}  // namespace

void TopicReader::Listener::queue(const WriterEvent& event) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    events_.push_back(event);
  }

  site_.wake();
}

void TopicReader::Listener::on_liveliness_changed(dds::DataReader*, const dds::LivelinessChangedStatus& status) {
  if (status.not_alive_count_change > 0) queue({status.last_publication_handle, true, true});
  if (status.alive_count_change > 0) queue({status.last_publication_handle, false, false});
}

void TopicReader::Listener::on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) {
  if (status.current_count_change < 0) queue({status.last_publication_handle, true, false});
}

std::vector<TopicReader::WriterEvent> TopicReader::Listener::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(events_, {});
}

/// The condition triggers on data, missed deadlines, rejected samples and misfits.
TopicReader::TopicReader(Site& site, const Site::Channel& channel)
    : site_(site),
      type_(channel.type),
      support_(channel.support),
      type_name_(channel.support.get_type_name()),
      listener_(site),
      sample_(fast::new_sample(support_)),
      reader_(&site.make_reader(channel, &listener_)) {
  condition().set_enabled_statuses(dds::StatusMask::data_available()
                                   << dds::StatusMask::requested_deadline_missed() << dds::StatusMask::sample_rejected()
                                   << dds::StatusMask::requested_incompatible_qos());
}

TopicReader::~TopicReader() { reader_->set_listener(nullptr); }

int TopicReader::matched_writers() const {
  dds::SubscriptionMatchedStatus status;
  reader_->get_subscription_matched_status(status);
  return status.current_count;
}

/// Samples first, then the ends of writers that did not come back, then the counts of what went wrong.
bool TopicReader::drain(const Report& report) {
  // Taken before the samples, handled after them: what a writer said last comes before its end.
  const std::vector<WriterEvent> events = listener_.take();
  bool handled = drain_samples(report);

  for (std::size_t i = 0; i < events.size(); ++i) {
    const bool returned =
        std::any_of(events.begin() + static_cast<std::ptrdiff_t>(i), events.end(),
                    [&](const WriterEvent& later) { return later.writer == events[i].writer && !later.gone; });
    if (events[i].gone && !returned) lose(events[i], report);
    handled = true;
  }

  report_statuses(report);
  return handled;
}

/// One sample at a time into the same object.
bool TopicReader::drain_samples(const Report& report) {
  int taken = 0;
  dds::SampleInfo info;

  while (taken < kSamplesPerTurn && fast::ok(reader_->take_next_sample(sample_.get(), &info))) {
    take(info, report);
    ++taken;
  }

  has_more_ = taken == kSamplesPerTurn;
  return taken > 0;
}

/// Data, or the end of an instance. Samples with bytes that do not fit the type are dropped and
/// reported.
void TopicReader::take(const dds::SampleInfo& info, const Report& report) {
  const Handle& writer = info.publication_handle;
  if (!info.valid_data) {
    end(info.instance_handle, writer, info.instance_state == dds::NOT_ALIVE_DISPOSED_INSTANCE_STATE);
    return;
  }

  if (!fast::last_sample_fits) {
    report(malformed_sample(type_->name, type_name_, participant_of(writer)));
    return;
  }

  if (type_->qos.depth > 0) {
    instances_.hear(info.instance_handle, writer, [this] {
      fast::Sample key = fast::new_sample(support_);
      type_->copy_key(key.get(), sample_.get());
      return key;
    });
  }

  hand_over(sample_.get(), SampleKind::kData, writer);
}

void TopicReader::end(const Handle& handle, const Handle& writer, bool disposed) {
  const std::optional<fast::Sample> key = instances_.end(handle, writer, disposed);
  if (key) hand_over(key->get(), disposed ? SampleKind::kDisposed : SampleKind::kNoWriters, writer);
}

void TopicReader::lose(const WriterEvent& event, const Report& report) {
  if (event.silent) report(liveliness_lost(type_->name, type_->qos, participant_of(event.writer)));
  for (const Handle& handle : instances_.heard_from(event.writer)) end(handle, event.writer, false);
  if (!event.silent) names_.erase(event.writer);
}

/// Reading a status also clears it; each kind is reported at most once in five seconds.
void TopicReader::report_statuses(const Report& report) {
  const dds::StatusMask changed = reader_->get_status_changes();
  const auto limited = [&](const Incident& incident) {
    if (quiet_.allows(incident.kind, monotonic_now())) report(incident);
  };

  if (changed.is_active(dds::StatusMask::requested_deadline_missed())) {
    dds::RequestedDeadlineMissedStatus status;
    reader_->get_requested_deadline_missed_status(status);
    limited(deadline_missed(type_->name, type_->qos, status.total_count));
  }

  if (changed.is_active(dds::StatusMask::sample_rejected())) {
    dds::SampleRejectedStatus status;
    reader_->get_sample_rejected_status(status);
    limited(samples_rejected(type_->name, status.total_count));
  }

  if (changed.is_active(dds::StatusMask::requested_incompatible_qos())) {
    dds::RequestedIncompatibleQosStatus status;
    reader_->get_requested_incompatible_qos_status(status);  // named with the peer by Discovery
  }
}

void TopicReader::hand_over(const void* sample, SampleKind kind, const Handle& writer) {
  const SampleInfo info{kind, name_of(writer), monotonic_now()};
  for (std::size_t i = 0; i < handlers_.size(); ++i) handlers_[i](sample, info);  // a handler may add handlers
}

const std::string& TopicReader::name_of(const Handle& writer) {
  const auto known = names_.find(writer);
  return known != names_.end() ? known->second : names_.emplace(writer, text_of_guid(writer)).first->second;
}

std::string TopicReader::participant_of(const Handle& writer) const {
  std::ostringstream prefix;
  prefix << fast::rtps::iHandle2GUID(writer).guidPrefix;
  return site_.discovery().describe(prefix.str());
}

}  // namespace aisle::bus
