#pragma once

// Everything in which Fast DDS 2.9 and 3.1 differ for us. Included by common/bus/dds/*.cpp (and tests that play a
// foreign peer) only.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <fastdds/dds/core/condition/GuardCondition.hpp>
#include <fastdds/dds/core/condition/StatusCondition.hpp>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/publisher/qos/PublisherQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/subscriber/qos/SubscriberQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#if AISLE_FASTDDS_MAJOR >= 3
#include <fastdds/LibrarySettings.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#endif

namespace aisle::bus::fast {

namespace dds = eprosima::fastdds::dds;
#if AISLE_FASTDDS_MAJOR >= 3
namespace rtps = eprosima::fastdds::rtps;

using Duration = dds::Duration_t;
using WriterInfo = const rtps::PublicationBuiltinTopicData&;
using ReaderInfo = const rtps::SubscriptionBuiltinTopicData&;
using ParticipantInfo = const rtps::ParticipantBuiltinTopicData&;
#else
namespace rtps = eprosima::fastrtps::rtps;

using Duration = eprosima::fastrtps::Duration_t;
using WriterInfo = const rtps::WriterProxyData&;
using ReaderInfo = const rtps::ReaderProxyData&;
using ParticipantInfo = const rtps::ParticipantProxyData&;
#endif
using UdpTransport = eprosima::fastdds::rtps::UDPv4TransportDescriptor;
using SharedMemoryTransport = eprosima::fastdds::rtps::SharedMemTransportDescriptor;

#if AISLE_FASTDDS_MAJOR >= 3
/// Did the call succeed?
inline bool ok(dds::ReturnCode_t code) { return code == dds::RETCODE_OK; }
#else
inline bool ok(const eprosima::fastrtps::types::ReturnCode_t& code) {
  return code == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
}

inline bool ok(bool written) { return written; }  // DataWriter::write
#endif

/// @pre t >= 0
inline Duration duration(std::chrono::nanoseconds t) {
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(t);
  return {static_cast<std::int32_t>(whole.count()), static_cast<std::uint32_t>((t - whole).count())};
}

/// Rounded up; 0 for an infinite duration.
inline std::chrono::milliseconds milliseconds(const Duration& t) {
  if (t.is_infinite()) return std::chrono::milliseconds{0};
  return std::chrono::milliseconds{static_cast<std::int64_t>(t.seconds) * 1000 + (t.nanosec + 999999) / 1000000};
}

/// How often a reliable writer asks for acknowledgements while some are missing.
inline void set_heartbeat(dds::DataWriterQos& qos, std::chrono::nanoseconds period) {
#if AISLE_FASTDDS_MAJOR >= 3
  qos.reliable_writer_qos().times.heartbeat_period = duration(period);
#else
  qos.reliable_writer_qos().times.heartbeatPeriod = duration(period);
#endif
}

/// Payloads start at kFirstPayloadBytes and grow to what is written; the dynamic policies refuse disposals, whose
/// payload is empty.
inline constexpr auto kMemoryPolicy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
inline constexpr std::uint32_t kFirstPayloadBytes = 256;

/// Uses a discovery server instead of multicast. `sees_all`: for tools, which want to hear of every
/// endpoint and not only of those that match theirs.
inline void join_discovery_server(dds::DomainParticipantQos& qos, const std::string& address, std::uint16_t port,
                                  bool sees_all) {
  rtps::Locator_t server;
  server.kind = LOCATOR_KIND_UDPv4;
  rtps::IPLocator::setIPv4(server, address);
  rtps::IPLocator::setPhysicalPort(server, port);

  auto& discovery = qos.wire_protocol().builtin.discovery_config;
#if AISLE_FASTDDS_MAJOR >= 3
  discovery.discoveryProtocol = sees_all ? rtps::DiscoveryProtocol::SUPER_CLIENT : rtps::DiscoveryProtocol::CLIENT;
  discovery.m_DiscoveryServers.push_back(server);
#else
  discovery.discoveryProtocol = sees_all ? rtps::DiscoveryProtocol_t::SUPER_CLIENT : rtps::DiscoveryProtocol_t::CLIENT;

  rtps::RemoteServerAttributes remote;
  remote.ReadguidPrefix("44.53.00.5f.45.50.52.4f.53.49.4d.41");  // what `fastdds discovery -i 0` calls itself
  remote.metatrafficUnicastLocatorList.push_back(server);
  discovery.m_DiscoveryServers.push_back(remote);
#endif
}

/// Two buses in one process (tests) talk as two processes do: through their transports.
inline void deliver_over_transports_only() {
#if AISLE_FASTDDS_MAJOR >= 3
  eprosima::fastdds::LibrarySettings settings;
  settings.intraprocess_delivery = eprosima::fastdds::INTRAPROCESS_OFF;
  dds::DomainParticipantFactory::get_instance()->set_library_settings(settings);
#else
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
#endif
}

/// Types are matched by their names: Cyclone DDS does not understand the type objects of 3.1.
inline void keep_types_off_the_wire([[maybe_unused]] dds::DomainParticipantQos& qos) {
#if AISLE_FASTDDS_MAJOR >= 3
  qos.properties().properties().emplace_back("fastdds.type_propagation", "registration_only");
#endif
}

/// A generated type whose decoder lets no exception out, whatever the bytes are, and whose key may be asked for by
/// several threads of the middleware at once (the generated one shares a buffer).
template <class Generated>
class Guarded final : public Generated {
 public:
  using typename Generated::type;

  /// Otherwise the middleware would preallocate the largest sample that the bounds allow, several
  /// times, and never grow.
  bool is_bounded() const override { return false; }

  Guarded() {
#if AISLE_FASTDDS_MAJOR >= 3
    this->max_serialized_type_size = kFirstPayloadBytes;
#else
    this->m_typeSize = kFirstPayloadBytes;
#endif
  }
#if AISLE_FASTDDS_MAJOR >= 3
  bool deserialize(rtps::SerializedPayload_t& payload, void* data) override {
    return guard(data, [&] {
      return Generated::deserialize(payload, data) && (is_xcdr2(payload) || is_length(payload, written_length(data)));
    });
  }

  bool compute_key(rtps::SerializedPayload_t& payload, rtps::InstanceHandle_t& handle,
                   bool force_md5 = false) override {
    const std::lock_guard<std::mutex> lock(key_mutex_);
    return nothrow([&] { return Generated::compute_key(payload, handle, force_md5); });
  }

  bool compute_key(const void* const data, rtps::InstanceHandle_t& handle, bool force_md5 = false) override {
    const std::lock_guard<std::mutex> lock(key_mutex_);
    return nothrow([&] { return Generated::compute_key(data, handle, force_md5); });
  }
#else
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    return guard(data, [&] {
      return Generated::deserialize(payload, data) && is_length(*payload, Generated::getSerializedSizeProvider(data)());
    });
  }

  bool getKey(void* data, rtps::InstanceHandle_t* handle, bool force_md5 = false) override {
    const std::lock_guard<std::mutex> lock(key_mutex_);
    return nothrow([&] { return Generated::getKey(data, handle, force_md5); });
  }
#endif

 private:
  /// Do the bytes have the length of the sample that was decoded from them? 3.1 takes a sample that
  /// ends early for one with defaults, and both releases take one with more fields: another version of
  /// the type, which must not pass for ours. Up to three bytes are padding.
  static bool is_length(const rtps::SerializedPayload_t& payload, std::uint32_t of_sample) {
    return payload.length + 3 >= of_sample && payload.length <= of_sample + 3;
  }

#if AISLE_FASTDDS_MAJOR >= 3
  /// Of the sample when it is written. What 3.1 calculates is no measure: it counts up to four bytes of alignment for
  /// each empty sequence of doubles, and does not write them.
  std::uint32_t written_length(const void* sample) {
    thread_local std::vector<std::uint8_t> bytes;
    bytes.resize(Generated::calculate_serialized_size(sample, dds::XCDR_DATA_REPRESENTATION));

    rtps::SerializedPayload_t payload;
    payload.data = bytes.data();
    payload.max_size = static_cast<std::uint32_t>(bytes.size());
    const bool written = Generated::serialize(sample, payload, dds::XCDR_DATA_REPRESENTATION);
    payload.data = nullptr;
    return written ? payload.length : 0;
  }
#endif

  /// Packed more tightly: its length says nothing here.
  static bool is_xcdr2(const rtps::SerializedPayload_t& payload) { return payload.length >= 4 && payload.data[1] > 1; }

  /// The result of `function`; false when it throws.
  template <class Function>
  static bool nothrow(Function function) {
    try {
      return function();
    } catch (const std::exception&) {
      return false;
    }
  }

  template <class Function>
  static bool guard(void* data, Function decode);

  std::mutex key_mutex_;
};

/// Did the newest sample that this thread decoded have bytes that fit its type? (take() does not tell.)
inline thread_local bool last_sample_fits = true;

template <class Generated>
template <class Function>
bool Guarded<Generated>::guard(void* data, Function decode) {
  last_sample_fits = nothrow(decode);
  if (!last_sample_fits) *static_cast<type*>(data) = type{};
  return true;  // else a reliable writer would send it again for ever; the reader of `last_sample_fits` drops it
}

/// A sample without its C++ type.
struct SampleDeleter {
  dds::TypeSupport support;

  void operator()(void* sample) const {
#if AISLE_FASTDDS_MAJOR >= 3
    support->delete_data(sample);
#else
    support->deleteData(sample);
#endif
  }
};

using Sample = std::unique_ptr<void, SampleDeleter>;

/// With default values.
inline Sample new_sample(const dds::TypeSupport& support) {
#if AISLE_FASTDDS_MAJOR >= 3
  return Sample(support->create_data(), SampleDeleter{support});
#else
  return Sample(support->createData(), SampleDeleter{support});
#endif
}

/// Size of the payload; 0 when it cannot be told.
inline std::size_t serialized_bytes(const dds::TypeSupport& support, const void* sample) {
#if AISLE_FASTDDS_MAJOR >= 3
  return support->calculate_serialized_size(sample, dds::DEFAULT_DATA_REPRESENTATION);
#else
  return support->getSerializedSizeProvider(const_cast<void*>(sample))();
#endif
}

/// A payload whose bytes belong to the caller: the middleware reads or fills them and does not free
/// them.
class BorrowedPayload {
 public:
  BorrowedPayload(std::uint8_t* data, std::size_t size) {
    payload_.data = data;
    payload_.max_size = payload_.length = static_cast<std::uint32_t>(size);
  }

  ~BorrowedPayload() { payload_.data = nullptr; }
  BorrowedPayload(const BorrowedPayload&) = delete;
  BorrowedPayload& operator=(const BorrowedPayload&) = delete;
  rtps::SerializedPayload_t& operator*() { return payload_; }

 private:
  rtps::SerializedPayload_t payload_;
};

/// A sample as it goes over the wire: XCDR version 1, little endian, with the four bytes of its encapsulation in front.
/// False, with no bytes, when it cannot be written.
inline bool encode(const dds::TypeSupport& support, const void* sample, std::vector<std::uint8_t>& bytes) {
#if AISLE_FASTDDS_MAJOR >= 3
  bytes.resize(support->calculate_serialized_size(sample, dds::XCDR_DATA_REPRESENTATION));

  BorrowedPayload payload(bytes.data(), bytes.size());
  const bool written = support->serialize(sample, *payload, dds::XCDR_DATA_REPRESENTATION);
#else
  void* data = const_cast<void*>(sample);
  bytes.resize(support->getSerializedSizeProvider(data)());

  BorrowedPayload payload(bytes.data(), bytes.size());
  const bool written = dds::TypeSupport(support)->serialize(data, &*payload);
#endif
  bytes.resize(written ? (*payload).length : 0);
  return written;
}

/// False when the bytes are no such sample.
inline bool decode(const dds::TypeSupport& support, const std::vector<std::uint8_t>& bytes, void* sample) {
  BorrowedPayload payload(const_cast<std::uint8_t*>(bytes.data()), bytes.size());  // it is only read
#if AISLE_FASTDDS_MAJOR >= 3
  support->deserialize(*payload, sample);
#else
  dds::TypeSupport(support)->deserialize(&*payload, sample);
#endif
  return last_sample_fits;
}

// Discovery: the same facts under other names.
#if AISLE_FASTDDS_MAJOR >= 3
inline const auto& guid_of(WriterInfo info) { return info.guid; }
inline const auto& guid_of(ReaderInfo info) { return info.guid; }
inline std::string topic_of(WriterInfo info) { return info.topic_name.to_string(); }
inline std::string topic_of(ReaderInfo info) { return info.topic_name.to_string(); }
inline std::string type_of(WriterInfo info) { return info.type_name.to_string(); }
inline std::string type_of(ReaderInfo info) { return info.type_name.to_string(); }
inline const auto& reliability_of(WriterInfo info) { return info.reliability; }
inline const auto& reliability_of(ReaderInfo info) { return info.reliability; }
inline const auto& durability_of(WriterInfo info) { return info.durability; }
inline const auto& durability_of(ReaderInfo info) { return info.durability; }
inline const auto& deadline_of(WriterInfo info) { return info.deadline; }
inline const auto& deadline_of(ReaderInfo info) { return info.deadline; }
inline const auto& ownership_of(WriterInfo info) { return info.ownership; }
inline const auto& ownership_of(ReaderInfo info) { return info.ownership; }
inline const auto& liveliness_of(WriterInfo info) { return info.liveliness; }
inline const auto& liveliness_of(ReaderInfo info) { return info.liveliness; }
inline const auto& partition_of(WriterInfo info) { return info.partition; }
inline const auto& partition_of(ReaderInfo info) { return info.partition; }
inline const auto& guid_of(ParticipantInfo info) { return info.guid; }
inline std::string name_of(ParticipantInfo info) { return info.participant_name.to_string(); }

inline std::string user_data_of(ParticipantInfo info) {
  const auto& bytes = info.user_data.data_vec();
  return {bytes.begin(), bytes.end()};
}
#else
inline const auto& guid_of(WriterInfo info) { return info.guid(); }
inline const auto& guid_of(ReaderInfo info) { return info.guid(); }
inline std::string topic_of(WriterInfo info) { return info.topicName().to_string(); }
inline std::string topic_of(ReaderInfo info) { return info.topicName().to_string(); }
inline std::string type_of(WriterInfo info) { return info.typeName().to_string(); }
inline std::string type_of(ReaderInfo info) { return info.typeName().to_string(); }
inline const auto& reliability_of(WriterInfo info) { return info.m_qos.m_reliability; }
inline const auto& reliability_of(ReaderInfo info) { return info.m_qos.m_reliability; }
inline const auto& durability_of(WriterInfo info) { return info.m_qos.m_durability; }
inline const auto& durability_of(ReaderInfo info) { return info.m_qos.m_durability; }
inline const auto& deadline_of(WriterInfo info) { return info.m_qos.m_deadline; }
inline const auto& deadline_of(ReaderInfo info) { return info.m_qos.m_deadline; }
inline const auto& ownership_of(WriterInfo info) { return info.m_qos.m_ownership; }
inline const auto& ownership_of(ReaderInfo info) { return info.m_qos.m_ownership; }
inline const auto& liveliness_of(WriterInfo info) { return info.m_qos.m_liveliness; }
inline const auto& liveliness_of(ReaderInfo info) { return info.m_qos.m_liveliness; }
inline const auto& partition_of(WriterInfo info) { return info.m_qos.m_partition; }
inline const auto& partition_of(ReaderInfo info) { return info.m_qos.m_partition; }
inline const auto& guid_of(ParticipantInfo info) { return info.m_guid; }
inline std::string name_of(ParticipantInfo info) { return info.m_participantName.to_string(); }

inline std::string user_data_of(ParticipantInfo info) {
  const auto& bytes = info.m_userData.data_vec();
  return {bytes.begin(), bytes.end()};
}
#endif

/// What a participant finds out about others, on a thread of the middleware: implementations only put it into a queue.
class DiscoveryListener : public dds::DomainParticipantListener {
 public:
  virtual void writer_seen(WriterInfo info, bool gone) = 0;
  virtual void reader_seen(ReaderInfo info, bool gone) = 0;
  virtual void participant_seen(ParticipantInfo info, bool gone) = 0;

#if AISLE_FASTDDS_MAJOR >= 3
  void on_data_writer_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryStatus reason, WriterInfo info,
                                bool&) final {
    writer_seen(info, reason == rtps::WriterDiscoveryStatus::REMOVED_WRITER);
  }

  void on_data_reader_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryStatus reason, ReaderInfo info,
                                bool&) final {
    reader_seen(info, reason == rtps::ReaderDiscoveryStatus::REMOVED_READER);
  }

  void on_participant_discovery(dds::DomainParticipant*, rtps::ParticipantDiscoveryStatus reason, ParticipantInfo info,
                                bool&) final {
    participant_seen(info, reason == rtps::ParticipantDiscoveryStatus::REMOVED_PARTICIPANT ||
                               reason == rtps::ParticipantDiscoveryStatus::DROPPED_PARTICIPANT);
  }
#else
  void on_publisher_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryInfo&& found) final {
    writer_seen(found.info, found.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER);
  }

  void on_subscriber_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& found) final {
    reader_seen(found.info, found.status == rtps::ReaderDiscoveryInfo::REMOVED_READER);
  }

  void on_participant_discovery(dds::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& found) final {
    participant_seen(found.info, found.status == rtps::ParticipantDiscoveryInfo::REMOVED_PARTICIPANT ||
                                     found.status == rtps::ParticipantDiscoveryInfo::DROPPED_PARTICIPANT);
  }
#endif
};

}  // namespace aisle::bus::fast
