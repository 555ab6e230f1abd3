#include "common/bus/dds/site.hpp"

#include <malloc.h>

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "common/bus/dds/participant_qos.hpp"
#include "common/config/reader.hpp"

namespace aisle::bus {
namespace {

namespace dds = fast::dds;

constexpr std::size_t kEndsAtOnce = 64;

/// stdout belongs to programs (`aisle topic echo --json`); the middleware complains on stderr, and of errors only.
void configure_process_once() {
  static std::once_flag once;

  std::call_once(once, [] {
    dds::Log::ClearConsumers();

    auto consumer = std::make_unique<dds::StdoutErrConsumer>();
    consumer->stderr_threshold(dds::Log::Kind::Info);
    dds::Log::RegisterConsumer(std::move(consumer));
    dds::Log::SetVerbosity(dds::Log::Kind::Error);
    fast::deliver_over_transports_only();
    mallopt(M_ARENA_MAX, 2);  // the middleware's ten threads allocate little; an arena for each costs megabytes
  });
}

/// To be called before a writer is deleted. Fast DDS 2.9 gives the changes back one by one while heartbeats go on; a
/// heartbeat that falls due just then looks through changes already given back, for ever, and the process never ends
/// (seen in 2 of 720 tries under load).
void forget_changes(dds::DataWriter& writer) {
  std::size_t removed = 0;
  writer.clear_history(&removed);
}

}  // namespace

Site::Site(const Settings& settings)
    : discovery_(settings.partition, [this] { wake(); }), partition_(settings.partition) {
  configure_process_once();

  const dds::DomainParticipantQos qos = participant_qos(settings);
  auto* factory = dds::DomainParticipantFactory::get_instance();

  participant_ = factory->create_participant(static_cast<dds::DomainId_t>(settings.domain), qos, &discovery_,
                                             dds::StatusMask::none());

  if (participant_ == nullptr) {
    const std::string hint =
        settings.security.enabled() ? "check the certificates and permissions (openssl smime -verify), and " : "";
    throw config::BadEnvironment("cannot join DDS domain " + std::to_string(settings.domain) + ": " + hint +
                                 "check that UDP ports from " + std::to_string(7400 + 250 * settings.domain) +
                                 " are free");
  }

  // One publisher and one subscriber carry the partition.
  dds::PublisherQos publisher = dds::PUBLISHER_QOS_DEFAULT;
  dds::SubscriberQos subscriber = dds::SUBSCRIBER_QOS_DEFAULT;

  if (!partition_.empty()) {
    publisher.partition().push_back(partition_.c_str());
    subscriber.partition().push_back(partition_.c_str());
  }

  publisher_ = participant_->create_publisher(publisher);
  subscriber_ = participant_->create_subscriber(subscriber);
}

/// The listener first: it must not be called while the entities go. Then the writers' histories, then
/// the entities.
Site::~Site() {
  if (participant_ == nullptr) return;

  participant_->set_listener(nullptr);

  std::vector<dds::DataWriter*> writers;
  if (publisher_ != nullptr) publisher_->get_datawriters(writers);
  for (dds::DataWriter* writer : writers) forget_changes(*writer);
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

/// One registration for readers and writers of the topic.
const Site::Channel& Site::channel(const std::string& name) {
  const auto known = channels_.find(name);
  if (known != channels_.end()) return known->second;

  const TopicType& type = topic_type(name);
  dds::TypeSupport support = type.make_support();

  support.register_type(participant_);

  dds::Topic* topic = participant_->create_topic(name, support.get_type_name(), dds::TOPIC_QOS_DEFAULT);
  if (topic == nullptr) throw config::BadEnvironment("cannot create topic " + name + ": out of memory?");

  return channels_.emplace(name, Channel{&type, std::move(support), topic}).first->second;
}

fast::dds::DataWriter& Site::make_writer(const Channel& channel, int strength) {
  dds::DataWriter* writer = publisher_->create_datawriter(channel.topic, writer_qos(channel.type->qos, strength));
  if (writer == nullptr) throw config::BadEnvironment(std::string("cannot create a writer of ") + channel.type->name);
  discovery_.add_local(channel.announced(true));
  return *writer;
}

/// The listener hears of leases and matches only; data comes through the condition.
fast::dds::DataReader& Site::make_reader(const Channel& channel, fast::dds::DataReaderListener* listener) {
  const dds::StatusMask heard = dds::StatusMask::liveliness_changed() << dds::StatusMask::subscription_matched();
  dds::DataReader* reader =
      subscriber_->create_datareader(channel.topic, reader_qos(channel.type->qos), listener, heard);
  if (reader == nullptr) throw config::BadEnvironment(std::string("cannot create a reader of ") + channel.type->name);

  discovery_.add_local(channel.announced(false));
  return *reader;
}

void Site::drop(fast::dds::DataWriter& writer) {
  forget_changes(writer);
  publisher_->delete_datawriter(&writer);
}

DdsWriter::DdsWriter(const std::shared_ptr<Site>& site, const Site::Channel& channel, int strength)
    : site_(site),
      writer_(site->make_writer(channel, strength)),
      type_(*channel.type),
      support_(channel.support),
      room_(static_cast<std::size_t>(channel.type->qos.max_kept)) {}

DdsWriter::~DdsWriter() {
  if (const auto site = site_.lock()) site->drop(writer_);
}

/// On a queue, what was written is remembered until readers have acknowledged it; that bounds it to
/// max_kept.
bool DdsWriter::write(const void* sample) {
  const auto site = site_.lock();
  if (!site) return false;

  void* data = const_cast<void*>(sample);  // 2.9 asks for it, and does not write
  if (room_ == 0) return fast::ok(writer_.write(data, dds::HANDLE_NIL));

  if (written_.size() >= std::min(room_, kEndsAtOnce)) end_acknowledged();

  if (written_.size() >= room_ || !fast::ok(writer_.write(data, dds::HANDLE_NIL))) return false;

  written_.push_back(fast::new_sample(support_));
  type_.copy_key(written_.back().get(), data);

  return true;
}

void DdsWriter::end_acknowledged() {
  if (!fast::ok(writer_.wait_for_acknowledgments(fast::duration(std::chrono::microseconds(1))))) return;
  for (const fast::Sample& key : written_) writer_.unregister_instance(key.get(), dds::HANDLE_NIL);
  written_.clear();
}

bool DdsWriter::dispose(const void* sample) {
  const auto site = site_.lock();
  return site && fast::ok(writer_.unregister_instance(const_cast<void*>(sample), dds::HANDLE_NIL));
}

void DdsWriter::assert_liveliness() {
  if (const auto site = site_.lock()) writer_.assert_liveliness();
}

int DdsWriter::matched_readers() const {
  const auto site = site_.lock();
  if (!site) return 0;

  dds::PublicationMatchedStatus status;
  writer_.get_publication_matched_status(status);

  return status.current_count;
}

bool DdsWriter::wait_until_acknowledged(std::chrono::milliseconds limit) {
  const auto site = site_.lock();
  return site && fast::ok(writer_.wait_for_acknowledgments(fast::duration(limit)));
}

}  // namespace aisle::bus
