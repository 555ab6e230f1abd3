#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/bus/dds/site.hpp"
#include "common/bus/heard_instances.hpp"
#include "common/bus/reader_incidents.hpp"

namespace aisle::bus {

/// Reads one topic for all its handlers.
class TopicReader {
 public:
  using Report = std::function<void(Incident)>;

  /// Makes the DDS reader. @pre `site` and `channel` outlive it
  TopicReader(Site& site, const Site::Channel& channel);
  ~TopicReader();
  TopicReader(const TopicReader&) = delete;
  TopicReader& operator=(const TopicReader&) = delete;

  /// A further handler; it is called after those before it.
  void add(detail::RawHandler handler) { handlers_.push_back(std::move(handler)); }

  /// Hands what has arrived to the handlers. False when there was nothing.
  bool drain(const Report& report);

  /// Did the last drain() leave samples, so as not to starve others?
  bool has_more() const { return has_more_; }

  /// Triggered when drain() has something to do.
  fast::dds::StatusCondition& condition() { return reader_->get_statuscondition(); }
  int matched_writers() const;
  const std::string& type_name() const { return type_name_; }
  const TopicType& type() const { return *type_; }

 private:
  using Handle = fast::rtps::InstanceHandle_t;

  /// A writer came back, fell silent or went.
  struct WriterEvent {
    Handle writer;
    bool gone;
    bool silent;  // beyond its lease, rather than closed
  };

  /// Runs on threads of the middleware: only queues.
  class Listener final : public fast::dds::DataReaderListener {
   public:
    explicit Listener(Site& site) : site_(site) {}
    void on_liveliness_changed(fast::dds::DataReader*, const fast::dds::LivelinessChangedStatus& status) override;
    void on_subscription_matched(fast::dds::DataReader*, const fast::dds::SubscriptionMatchedStatus& status) override;
    std::vector<WriterEvent> take();

   private:
    void queue(const WriterEvent& event);

    Site& site_;
    std::mutex mutex_;
    std::vector<WriterEvent> events_;
  };

  /// At most kSamplesPerTurn of them.
  bool drain_samples(const Report& report);
  void take(const fast::dds::SampleInfo& info, const Report& report);

  /// A writer ended an instance; handlers hear of it when it was the last.
  void end(const Handle& instance, const Handle& writer, bool disposed);

  /// Ends the instances that only this writer wrote.
  void lose(const WriterEvent& event, const Report& report);

  /// Missed deadlines and rejected samples.
  void report_statuses(const Report& report);
  void hand_over(const void* sample, SampleKind kind, const Handle& writer);

  /// GUID as text, kept for the next time.
  const std::string& name_of(const Handle& writer);
  std::string participant_of(const Handle& writer) const;

  Site& site_;
  const TopicType* type_;
  fast::dds::TypeSupport support_;
  std::string type_name_;
  Listener listener_;
  fast::Sample sample_;
  fast::dds::DataReader* reader_;
  std::vector<detail::RawHandler> handlers_;
  HeardInstances<Handle, Handle, fast::Sample> instances_;
  std::map<Handle, std::string> names_;  // of writers
  QuietTime quiet_;
  bool has_more_{false};
};

}  // namespace aisle::bus
