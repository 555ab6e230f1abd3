#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "common/bus/bus.hpp"
#include "common/service/sender.hpp"
#include "common/service/topic_values.hpp"

namespace aisle::service {

/// How an instance ended.
enum class End {
  kDisposed,  // its writer says that it is gone
  kSilent,    // every writer of it is gone, or silent beyond its lease
};

namespace detail {

/// What an inbox needs of its shell. An interface, so that the shell's code is compiled once and not
/// once a topic.
class InboxOwner {
 public:
  virtual ~InboxOwner() = default;

  /// Runs `work` unless this shell has failed; see Shell.
  virtual void guarded(const std::function<void()>& work) = 0;

  /// Counts `dropped_<topic>` and warns, at most once in ten seconds for each topic.
  virtual void note_dropped(const std::string& topic, const std::string& reason) = 0;
};

/// The handlers of one shell for one topic; `gone` and `refused` may be empty.
template <class Topic>
struct Subscription {
  InboxOwner& owner;
  std::function<void(const ValueOf<Topic>&, const Sender&)> take;
  std::function<void(const KeyOf<Topic>&, End)> gone;
  std::function<void(const KeyOf<Topic>&, const std::string& reason)> refused;
};

/// One reader of a topic for all shells of a process: each sample is decoded once, then handed to every subscription.
template <class Topic>
class Channel {
 public:
  using Sample = typename Topic::Sample;

  /// Reads the topic as long as the bus runs. @pre it lives as long as the bus
  explicit Channel(bus::Bus& bus) {
    bus.on<Topic>([this](const Sample& sample, const bus::SampleInfo& info) {
      if (info.kind == bus::SampleKind::kData) {
        hand_over(sample, info);
      } else {
        end(sample, info.kind == bus::SampleKind::kDisposed ? End::kDisposed : End::kSilent);
      }
    });
  }

  /// @returns the place where it is kept, valid as long as the channel
  Subscription<Topic>& add(Subscription<Topic> subscription) {
    subscriptions_.push_back(std::move(subscription));  // a deque: what is there stays where it is
    return subscriptions_.back();
  }

 private:
  /// Decodes once and calls every subscription; a sample that is refused is counted for each.
  void hand_over(const Sample& sample, const bus::SampleInfo& info) {
    const auto decoded = wire::decode(sample);
    const Sender sender{wire::origin_of(sample), info.arrived};
    const std::size_t count = subscriptions_.size();  // what a handler adds hears from the next sample on

    for (std::size_t i = 0; i < count; ++i) {
      Subscription<Topic>& subscription = subscriptions_[i];

      subscription.owner.guarded([&] {
        if (decoded) return subscription.take(*decoded, sender);
        subscription.owner.note_dropped(Topic::kName, decoded.reason());
        if (subscription.refused) subscription.refused(key_of<Topic>(sample), decoded.reason());
      });
    }
  }

  void end(const Sample& sample, End how) {
    const std::size_t count = subscriptions_.size();
    for (std::size_t i = 0; i < count; ++i) {
      Subscription<Topic>& subscription = subscriptions_[i];
      if (subscription.gone) subscription.owner.guarded([&] { subscription.gone(key_of<Topic>(sample), how); });
    }
  }

  std::deque<Subscription<Topic>> subscriptions_;
};

}  // namespace detail

/// What Shell::inbox() returns, to add handlers for what is rare:
///
///   shell.inbox<topics::Track>([this](const fleet::Track& track, const Sender& from) { ... })
///       .on_gone([this](std::uint64_t track_id, End) { ... });
template <class Topic>
class Inbox {
 public:
  Inbox() = default;

  /// Made by Shell::inbox().
  Inbox(bus::Bus& bus, detail::Subscription<Topic>& subscription) : bus_(&bus), subscription_(&subscription) {}

  /// An instance of which data came has ended.
  const Inbox& on_gone(std::function<void(const KeyOf<Topic>&, End)> handler) const {
    subscription_->gone = std::move(handler);
    return *this;
  }

  /// A sample that the codec refused, after it was counted. The key may be anything.
  const Inbox& on_refused(std::function<void(const KeyOf<Topic>&, const std::string& reason)> handler) const {
    subscription_->refused = std::move(handler);
    return *this;
  }

  /// Writers of this topic that we hear, our own included.
  int matched_writers() const { return bus_->matched_writers(Topic::kName); }

 private:
  bus::Bus* bus_{nullptr};
  detail::Subscription<Topic>* subscription_{nullptr};
};

}  // namespace aisle::service
