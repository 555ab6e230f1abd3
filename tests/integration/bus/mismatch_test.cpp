// A foreign participant whose type, QoS or bytes do not fit ours is named, and harms nobody.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/dds/fastdds_compat.hpp"
#include "common/bus/qos_conflict.hpp"
#include "idl/planning_support.hpp"
#include "tests/integration/bus/stranger.hpp"
#include "tests/integration/bus/two_buses.hpp"

namespace aisle::bus_test {
namespace {

namespace fast = bus::fast;
namespace dds = bus::fast::dds;

/// Writes the first bytes of what the type would be: as a broken or hostile peer does.
class Truncated final : public aisle::GoalPubSubType {
 public:
  Truncated() { set_name(); }
#if AISLE_FASTDDS_MAJOR >= 3
  bool serialize(const void* const data, fast::rtps::SerializedPayload_t& payload,
                 dds::DataRepresentationId_t id) override {
    return GoalPubSubType::serialize(data, payload, id) && cut(payload);
  }
#else
  bool serialize(void* data, fast::rtps::SerializedPayload_t* payload) override {
    return GoalPubSubType::serialize(data, payload) && cut(*payload);
  }
#endif

 private:
#if AISLE_FASTDDS_MAJOR >= 3
  void set_name() { GoalPubSubType::set_name("aisle::Goal"); }
#else
  void set_name() { setName("aisle::Goal"); }
#endif
  static bool cut(fast::rtps::SerializedPayload_t& payload) {
    payload.length = 40;
    return true;
  }
};

/// A bus that reads goals and keeps its incidents.
struct GoalReader {
  explicit GoalReader(int domain) : bus(loopback(domain)) {
    bus.on<topics::Goal>(
        [this](const aisle::Goal& goal, const bus::SampleInfo&) { goals.push_back(goal.agv_id().to_string()); });
    bus.on_incident([this](const bus::Incident& incident) { incidents.push_back(incident); });
  }
  bool reports(bus::Incident::Kind kind, const std::vector<std::string>& words) {
    return run_until(
        {&bus},
        [&] {
          return std::any_of(incidents.begin(), incidents.end(), [&](const bus::Incident& incident) {
            const auto has = [&](const std::string& word) { return incident.text.find(word) != std::string::npos; };
            return incident.kind == kind && incident.topic == "goal" && std::all_of(words.begin(), words.end(), has);
          });
        },
        5s);
  }
  DdsBus bus;
  std::vector<std::string> goals;
  std::vector<bus::Incident> incidents;
};

TEST(Mismatch, AWriterWithWeakerQosIsNamed) {
  GoalReader reader(216);
  Stranger stranger(216);
  stranger.writer("goal", dds::TypeSupport(new aisle::GoalPubSubType), topics::kStream);
  EXPECT_TRUE(reader.reports(bus::Incident::Kind::kIncompatibleQos, {"stranger", "reliability", "best effort"}));
}

TEST(Mismatch, AnotherTypeOnOurTopicIsNamed) {
  GoalReader reader(217);
  Stranger stranger(217);
  stranger.writer("goal", dds::TypeSupport(new aisle::PlanPubSubType), topics::kState);
  EXPECT_TRUE(reader.reports(bus::Incident::Kind::kTypeMismatch, {"stranger", "aisle::Plan", "aisle::Goal"}));
}

TEST(Mismatch, BytesThatAreNoSampleAreDroppedAndGoodOnesStillArrive) {
  GoalReader reader(218);
  Stranger stranger(218);
  auto* bad = stranger.writer("goal", dds::TypeSupport(new Truncated), topics::kState);
  Stranger friendly(218);
  auto* good = friendly.writer("goal", dds::TypeSupport(new aisle::GoalPubSubType), topics::kState);
  aisle::Goal goal;
  goal.agv_id("bad");
  goal.goal_id(std::string(60, 'x'));
  ASSERT_TRUE(fast::ok(bad->write(&goal)));
  EXPECT_TRUE(reader.reports(bus::Incident::Kind::kMalformedSample, {"stranger", "aisle::Goal"}));
  goal.agv_id("good");
  ASSERT_TRUE(fast::ok(good->write(&goal)));
  ASSERT_TRUE(run_until({&reader.bus}, [&] { return !reader.goals.empty(); }));
  EXPECT_EQ(reader.goals, std::vector<std::string>{"good"});
}

TEST(Mismatch, PoliciesAreComparedAsDdsDoes) {
  using bus::Qos;
  using bus::qos_conflict;
  const Qos plan = topics::Plan::kQos;
  EXPECT_EQ(qos_conflict(plan, true, plan, true), "");
  EXPECT_EQ(qos_conflict(topics::kState, false, topics::kStream, false), "");
  Qos offered = plan;
  offered.ownership = bus::Ownership::kShared;
  EXPECT_NE(qos_conflict(offered, true, plan, true).find("ownership"), std::string::npos);
  EXPECT_NE(qos_conflict(plan, false, plan, true).find("liveliness"), std::string::npos);
  offered = plan;
  offered.liveliness_lease = 300ms;
  EXPECT_NE(qos_conflict(offered, true, plan, true).find("300 ms is offered, 200 ms"), std::string::npos);
  offered = plan;
  offered.durability = bus::Durability::kVolatile;
  EXPECT_NE(qos_conflict(offered, true, plan, true).find("durability"), std::string::npos);
  Qos asked = topics::VehicleState::kQos;
  EXPECT_NE(qos_conflict(topics::kStream, false, asked, false).find("deadline: none is offered, 200 ms"),
            std::string::npos);
}

}  // namespace
}  // namespace aisle::bus_test
