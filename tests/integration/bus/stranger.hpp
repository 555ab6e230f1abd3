#pragma once
// Plays a foreign participant: made of the middleware, without our bus.
#include "common/bus/dds/fastdds_compat.hpp"
#include "common/bus/dds/participant_qos.hpp"
#include "tests/integration/bus/two_buses.hpp"

namespace aisle::bus_test {

/// A participant of somebody else, with whatever QoS.
class Stranger {
 public:
  explicit Stranger(int domain) {
    participant_ = bus::fast::dds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<bus::fast::dds::DomainId_t>(domain), bus::participant_qos(loopback(domain, "stranger")));
  }
  ~Stranger() {
    participant_->delete_contained_entities();
    bus::fast::dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  bus::fast::dds::DataWriter* writer(const char* topic, bus::fast::dds::TypeSupport type, const bus::Qos& qos) {
    type.register_type(participant_);
    auto* made = participant_->create_topic(topic, type.get_type_name(), bus::fast::dds::TOPIC_QOS_DEFAULT);
    return participant_->create_publisher(bus::fast::dds::PUBLISHER_QOS_DEFAULT)
        ->create_datawriter(made, bus::writer_qos(qos, 0));
  }

 private:
  bus::fast::dds::DomainParticipant* participant_{nullptr};
};

}  // namespace aisle::bus_test
