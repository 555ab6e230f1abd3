#pragma once

#include "common/bus/dds/fastdds_compat.hpp"
#include "common/bus/qos.hpp"
#include "common/bus/settings.hpp"

namespace aisle::bus {

/// How a process joins its site: transports, discovery, security, name. @throws config::BadInput for
/// values that are not usable, config::BadEnvironment when this host has no such interface
fast::dds::DomainParticipantQos participant_qos(const Settings& settings);

/// The middleware's settings for a topic's QoS. `strength`: on topics with exclusive ownership.
fast::dds::DataWriterQos writer_qos(const Qos& qos, int strength);
fast::dds::DataReaderQos reader_qos(const Qos& qos);

}  // namespace aisle::bus
