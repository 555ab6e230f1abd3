#pragma once

// What handlers of a bus are told beside the sample.

#include <string>
#include <vector>

#include "common/bus/qos.hpp"
#include "common/time/stamp.hpp"

namespace aisle::bus {

/// What a handler is called for.
enum class SampleKind {
  kData,
  kDisposed,   // the writer says that this instance is gone; only the key fields of the sample hold
  kNoWriters,  // every writer of this instance is gone or silent beyond its lease; only the key fields hold
};

/// kDisposed and kNoWriters come for instances of which data came before, and not on queues (depth 0).
struct SampleInfo {
  SampleKind kind{SampleKind::kData};
  std::string writer;     // GUID, for logs
  time::Stamp arrived{};  // when it was handed over, on the clock of the bus (see Bus::now)
};

/// An event on our site that a person must know about, with names: the topic, the peer, what does not
/// fit.
struct Incident {
  enum class Kind {
    kIncompatibleQos,
    kTypeMismatch,
    kDeadlineMissed,
    kLivelinessLost,
    kSampleRejected,
    kMalformedSample
  };

  Kind kind;
  std::string topic;
  std::string text;  // one line
};

/// An endpoint seen on the wire (our own too), for inspection.
struct Endpoint {
  std::string topic, type, participant, host;
  bool is_writer{false};
  Qos qos;  // history is not announced: depth is 0 for those of others
  std::vector<std::string> partitions;
};

/// Another participant of the domain, whatever its partition.
struct Participant {
  std::string name, host;
  int process_id{0};  // 0: unknown
};

}  // namespace aisle::bus
