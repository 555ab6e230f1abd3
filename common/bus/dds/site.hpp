#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/dds/discovery.hpp"
#include "common/bus/dds/fastdds_compat.hpp"
#include "common/bus/dds/type_table.hpp"

namespace aisle::bus {

/// Our participant with all its entities; its destructor takes them down in the order that the middleware wants.
class Site {
 public:
  /// @throws config::BadEnvironment, config::BadInput
  explicit Site(const Settings& settings);
  ~Site();
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  /// A topic as it is registered with our participant.
  struct Channel {
    const TopicType* type;
    fast::dds::TypeSupport support;
    fast::dds::Topic* topic;

    Announced announced(bool is_writer) const {
      return {type->name, support.get_type_name(), is_writer, type->qos, type->qos.liveliness_lease.count() > 0};
    }
  };

  /// Registers the topic at its first use.
  const Channel& channel(const std::string& name);

  /// @throws config::BadEnvironment when the middleware cannot make it; the same for make_reader()
  fast::dds::DataWriter& make_writer(const Channel& channel, int strength);
  fast::dds::DataReader& make_reader(const Channel& channel, fast::dds::DataReaderListener* listener);

  /// Deletes a writer of make_writer().
  void drop(fast::dds::DataWriter& writer);

  /// Ends the loop's wait, from any thread.
  void wake() { guard_.set_trigger_value(true); }
  fast::dds::GuardCondition& guard() { return guard_; }
  Discovery& discovery() { return discovery_; }

 private:
  fast::dds::GuardCondition guard_;
  Discovery discovery_;
  std::string partition_;
  fast::dds::DomainParticipant* participant_{nullptr};
  fast::dds::Publisher* publisher_{nullptr};
  fast::dds::Subscriber* subscriber_{nullptr};
  std::map<std::string, Channel> channels_;
};

/// See bus.hpp. Outlives its bus without harm.
class DdsWriter final : public detail::RawWriter {
 public:
  DdsWriter(const std::shared_ptr<Site>& site, const Site::Channel& channel, int strength);
  ~DdsWriter() override;
  DdsWriter(const DdsWriter&) = delete;
  DdsWriter& operator=(const DdsWriter&) = delete;

  bool write(const void* sample) override;
  bool dispose(const void* sample) override;
  void assert_liveliness() override;
  int matched_readers() const override;
  bool wait_until_acknowledged(std::chrono::milliseconds limit) override;

 private:
  /// Ends the instances of a queue whose samples all arrived, so that ids used once pile up neither here nor at
  /// readers. (An end written right behind its sample would leave 1.5 kB here with 2.9.)
  void end_acknowledged();

  std::weak_ptr<Site> site_;
  fast::dds::DataWriter& writer_;
  const TopicType& type_;
  fast::dds::TypeSupport support_;
  std::size_t room_;                   // of a queue, else 0
  std::vector<fast::Sample> written_;  // to a queue, and perhaps not yet acknowledged; only the key fields hold
};

}  // namespace aisle::bus
