#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace aisle::bus {

/// Remembers from which writers each instance of a reader was heard: a middleware does not tell when
/// the last of them goes. `Key`: a sample of which only the key fields are set.
template <class Instance, class Writer, class Key>
class HeardInstances {
 public:
  /// Data of `instance` came from `writer`. `make_key` is called when the instance is new.
  template <class MakeKey>
  void hear(const Instance& instance, const Writer& writer, const MakeKey& make_key) {
    auto found = instances_.find(instance);
    if (found == instances_.end()) found = instances_.emplace(instance, Heard{make_key(), {}}).first;
    std::vector<Writer>& writers = found->second.writers;
    if (std::find(writers.begin(), writers.end(), writer) == writers.end()) writers.push_back(writer);
  }

  /// `writer` disposed of the instance, or stopped writing it. Returns the key when the instance ends
  /// by that: it was heard before, and it is disposed or has no writer left.
  std::optional<Key> end(const Instance& instance, const Writer& writer, bool disposed) {
    const auto found = instances_.find(instance);
    if (found == instances_.end()) return std::nullopt;

    std::vector<Writer>& writers = found->second.writers;
    writers.erase(std::remove(writers.begin(), writers.end(), writer), writers.end());

    if (!disposed && !writers.empty()) return std::nullopt;

    std::optional<Key> key = std::move(found->second.key);
    instances_.erase(found);

    return key;
  }

  /// The instances that are written by `writer`, perhaps among others.
  std::vector<Instance> heard_from(const Writer& writer) const {
    std::vector<Instance> heard;
    for (const auto& [instance, entry] : instances_) {
      const auto& writers = entry.writers;
      if (std::find(writers.begin(), writers.end(), writer) != writers.end()) heard.push_back(instance);
    }

    return heard;
  }

 private:
  struct Heard {
    Key key;
    std::vector<Writer> writers;
  };

  std::map<Instance, Heard> instances_;
};

}  // namespace aisle::bus
