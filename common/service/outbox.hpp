#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "common/bus/bus.hpp"
#include "common/service/topic_values.hpp"

namespace aisle::service {

namespace detail {

/// What an outbox needs of its shell.
class OutboxOwner {
 public:
  virtual ~OutboxOwner() = default;

  /// Source, boot and wall clock; epoch and sequence number are the outbox's.
  virtual fleet::Origin origin() = 0;

  /// A shell that failed writes nothing more.
  virtual bool may_write() const = 0;

  /// Counts `<topic>_not_written`.
  virtual void note_not_written(const std::string& topic) = 0;
};

}  // namespace detail

/// Writes the values of one topic, each stamped with source, boot, epoch, sequence number from 1, and
/// wall clock.
///
/// On a topic with exclusive ownership it is closed until claim(): only the instance that leads has a
/// writer. Made by Shell::outbox(); copies share one writer and one count. Default-constructed, it
/// writes nothing.
template <class Topic>
class Outbox {
 public:
  using Sample = typename Topic::Sample;
  using Value = ValueOf<Topic>;

  Outbox() = default;

  /// Made by Shell::outbox().
  Outbox(bus::Bus& bus, detail::OutboxOwner& owner)
      : state_(std::make_shared<State>(State{bus, owner, {}, false, 1, 0})) {
    if constexpr (Topic::kQos.ownership != bus::Ownership::kExclusive) claim(1, 0);
  }

  /// False while the outbox is closed; false, and counted, when the queue is full of what readers did not acknowledge.
  bool write(const Value& value) { return write_sample(wire::encode(value)); }

  /// For samples with fields that the value does not have.
  bool write_sample(Sample sample) {
    if (!state_ || !state_->is_open || !state_->owner.may_write()) return false;

    fleet::Origin by = state_->owner.origin();
    by.epoch = state_->epoch;
    by.sequence_number = ++state_->sequence_number;
    wire::stamp(sample, by);

    if (state_->writer.write(sample)) return true;

    state_->owner.note_not_written(Topic::kName);
    return false;
  }

  /// Tells readers that this instance is gone. False when it was never written.
  bool dispose(const KeyOf<Topic>& key) { return state_ && state_->writer.dispose(sample_of_key<Topic>(key)); }

  /// Opens the writer anew with this epoch and strength: among the writers of an instance the strongest is heard.
  void claim(std::uint32_t epoch, int strength) {
    if (!state_) return;
    state_->epoch = epoch;
    state_->writer = state_->bus.template writer<Topic>(strength);
    state_->is_open = true;
  }

  /// Closes the writer: the next strongest is heard.
  void release() {
    if (!state_) return;
    state_->writer = {};
    state_->is_open = false;
  }

  /// For topics with a lease, when there is nothing new to write.
  void assert_liveliness() {
    if (state_ && state_->owner.may_write()) state_->writer.assert_liveliness();
  }

  /// Readers that it reaches; 0 while it is closed.
  int matched_readers() const { return state_ ? state_->writer.matched_readers() : 0; }

 private:
  struct State {
    bus::Bus& bus;
    detail::OutboxOwner& owner;
    bus::Writer<Topic> writer;
    bool is_open;
    std::uint32_t epoch;
    std::uint64_t sequence_number;
  };

  std::shared_ptr<State> state_;
};

}  // namespace aisle::service
