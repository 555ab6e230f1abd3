#pragma once

#include <functional>
#include <string>
#include <utility>

#include "common/bus/bus.hpp"
#include "common/service/inbox.hpp"

namespace aisle::service {

/// The handlers of a tool without a shell for one topic; those that are empty are not called.
template <class Topic>
struct Ear {
  std::function<void(const ValueOf<Topic>&, const Sender&)> take;
  std::function<void(const KeyOf<Topic>&, End)> gone;

  /// A sample that the codec refused. The key may be anything.
  std::function<void(const KeyOf<Topic>&, const std::string& reason)> refused;
};

/// Reads a topic without a shell: a tool gets values and never sees a sample.
///
///   service::hear<topics::Track>(bus, {[this](const fleet::Track& track, const service::Sender&) { ... }, {}, {}});
template <class Topic>
void hear(bus::Bus& bus, Ear<Topic> ear) {
  bus.on<Topic>([ear = std::move(ear)](const typename Topic::Sample& sample, const bus::SampleInfo& info) {
    if (info.kind != bus::SampleKind::kData) {
      const End how = info.kind == bus::SampleKind::kDisposed ? End::kDisposed : End::kSilent;
      if (ear.gone) ear.gone(key_of<Topic>(sample), how);
      return;
    }

    const auto decoded = wire::decode(sample);
    if (!decoded) {
      if (ear.refused) ear.refused(key_of<Topic>(sample), decoded.reason());
    } else if (ear.take) {
      ear.take(*decoded, Sender{wire::origin_of(sample), info.arrived});
    }
  });
}

}  // namespace aisle::service
