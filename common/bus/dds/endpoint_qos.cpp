#include <algorithm>
#include <chrono>

#include "common/bus/dds/participant_qos.hpp"

namespace aisle::bus {
namespace {

using namespace std::chrono_literals;

namespace dds = fast::dds;

/// What writers and readers have in common.
template <class EndpointQos>
void apply(const Qos& qos, EndpointQos& endpoint) {
  endpoint.reliability().kind =
      qos.reliability == Reliability::kReliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  endpoint.durability().kind = qos.durability == Durability::kTransientLocal ? dds::TRANSIENT_LOCAL_DURABILITY_QOS
                                                                             : dds::VOLATILE_DURABILITY_QOS;
  endpoint.ownership().kind =
      qos.ownership == Ownership::kExclusive ? dds::EXCLUSIVE_OWNERSHIP_QOS : dds::SHARED_OWNERSHIP_QOS;
  if (qos.deadline > 0ms) endpoint.deadline().period = fast::duration(qos.deadline);

  if (qos.liveliness_lease > 0ms) {
    endpoint.liveliness().kind = dds::MANUAL_BY_TOPIC_LIVELINESS_QOS;
    endpoint.liveliness().lease_duration = fast::duration(qos.liveliness_lease);
    endpoint.liveliness().announcement_period = fast::duration(qos.liveliness_lease / 2);
  }

  endpoint.history().kind = qos.depth > 0 ? dds::KEEP_LAST_HISTORY_QOS : dds::KEEP_ALL_HISTORY_QOS;
  endpoint.history().depth = std::max(1, qos.depth);
  endpoint.data_sharing().off();
  endpoint.endpoint().history_memory_policy = fast::kMemoryPolicy;

  // The defaults allow ten instances: the eleventh vehicle would be dropped. 0: no limit.
  endpoint.resource_limits().max_samples = 0;
  endpoint.resource_limits().max_instances = 0;
  endpoint.resource_limits().max_samples_per_instance = 0;
  endpoint.resource_limits().allocated_samples = 4;
  endpoint.resource_limits().extra_samples = 1;
}

}  // namespace

/// Heartbeats every 50 ms repair a loss soon; a write blocks at most 10 ms when the history is full.
dds::DataWriterQos writer_qos(const Qos& qos, int strength) {
  dds::DataWriterQos writer = dds::DATAWRITER_QOS_DEFAULT;
  apply(qos, writer);
  writer.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;

  if (qos.ownership == Ownership::kExclusive)
    writer.ownership_strength().value = static_cast<std::uint32_t>(std::max(0, strength));

  if (qos.reliability == Reliability::kReliable) {
    fast::set_heartbeat(writer, 50ms);
    writer.reliability().max_blocking_time = fast::duration(10ms);
  }

  // The end of a queue's instance is not a disposal; everywhere else, to unregister is to dispose.
  writer.writer_data_lifecycle().autodispose_unregistered_instances = qos.depth > 0;
  return writer;
}

dds::DataReaderQos reader_qos(const Qos& qos) {
  dds::DataReaderQos reader = dds::DATAREADER_QOS_DEFAULT;
  apply(qos, reader);
  return reader;
}

}  // namespace aisle::bus
