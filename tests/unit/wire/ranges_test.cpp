// Samples whose bytes are random never give a value outside the ranges that common/fleet documents.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "common/bus/sample_codec.hpp"
#include "common/bus/topics.hpp"
#include "common/wire/codecs.hpp"
#include "tests/support/every_topic.hpp"
#include "tests/unit/wire/sound_samples.hpp"

namespace aisle::wire {
namespace {

void expect_place(geometry::Point2 p) {
  EXPECT_LE(std::abs(p.x), 1e6);
  EXPECT_LE(std::abs(p.y), 1e6);
}
void expect_pose(const geometry::Pose2& pose) {
  expect_place(pose.position());
  EXPECT_LE(std::abs(pose.yaw), geometry::kPi);
}
void expect_twist(const geometry::Twist2& twist) {
  EXPECT_LE(std::abs(twist.linear_mps), 100.0);
  EXPECT_LE(std::abs(twist.angular_radps), 100.0);
  EXPECT_LE(std::abs(twist.sideways_mps), 100.0);
}
void expect_id(const std::string& id) {
  EXPECT_FALSE(id.empty());
  EXPECT_FALSE(Checks::has_control_characters(id));
}
void expect_within(double value, double low, double high) { EXPECT_TRUE(value >= low && value <= high) << value; }

/// Of a value without a rule below, tests/data/refusals says what its codec checks.
template <class Value>
void expect_sound(const Value&) {}

void expect_sound(const fleet::Vehicle& vehicle) {
  expect_id(vehicle.id);
  expect_within(vehicle.reach_m(), 0.01, 20.0);
  expect_within(vehicle.limits.max_speed_mps, 0.01, 100.0);
  expect_within(vehicle.limits.max_reverse_mps, 0.0, 100.0);
  expect_within(vehicle.limits.max_turn_radps, 0.01, 100.0);
  expect_within(vehicle.limits.max_deceleration_mps2, 0.01, 100.0);
  expect_within(vehicle.sensor_range_m, 0.0, 1000.0);
  expect_within(vehicle.command_timeout_s, 0.0, 60.0);
}
void expect_sound(const fleet::VehicleState& state) {
  expect_id(state.agv_id);
  expect_pose(state.motion.base_in_map);
  expect_twist(state.motion.twist);
  expect_within(state.motion.steering_rad, -geometry::kPi, geometry::kPi);
  EXPECT_STRNE(name(state.hold), "unknown");
  if (state.command) expect_id(state.command->agv_id);
}
void expect_sound(const fleet::Scan& scan) {
  expect_id(scan.agv_id);  // the rest is the tracker's to judge
  EXPECT_LE(scan.ranges_m.size(), 1440U);
}
void expect_sound(const fleet::Goal& goal) {
  expect_id(goal.agv_id);
  expect_id(goal.id);
  expect_pose(goal.pose_in_map);
  expect_within(goal.position_tolerance_m, 0.0, 100.0);
  expect_within(goal.yaw_tolerance_rad, 0.0, 7.0);
}
void expect_sound(const fleet::Plan& plan) {
  expect_id(plan.agv_id);
  EXPECT_STRNE(name(plan.outcome), "?");
  EXPECT_STRNE(name(plan.trigger), "?");
  expect_pose(plan.goal_in_map);
  expect_within(plan.position_tolerance_m, 0.0, 100.0);
  expect_within(plan.yaw_tolerance_rad, 0.0, 7.0);
  expect_within(plan.length_m, 0.0, 1e9);
  EXPECT_TRUE(!plan.is_found() || !plan.waypoints_in_map.empty());
  for (const geometry::Point2 point : plan.waypoints_in_map) expect_place(point);

  expect_within(plan.tube_m, 0.0, 100.0);
  double before_m = 0.0;
  for (const double end_m : plan.step_ends_m) {
    expect_within(end_m, before_m, 1e9);
    before_m = end_m;
  }
  EXPECT_TRUE(plan.own_steps.empty() || plan.own_steps.size() == plan.step_ends_m.size());
  EXPECT_TRUE(plan.headings_rad.empty() || plan.headings_rad.size() == plan.waypoints_in_map.size());
  for (const double heading_rad : plan.headings_rad) expect_within(heading_rad, -geometry::kPi, geometry::kPi);
}
void expect_sound(const fleet::Grant& grant) {
  expect_id(grant.agv_id);
  EXPECT_GT(grant.number, 0U);
  expect_within(grant.limit_m, 0.0, 1e9);
  EXPECT_LE(grant.extra.size(), 32U);
  std::uint64_t before = 0;
  for (const fleet::ExtraWidth& extra : grant.extra) {
    EXPECT_GE(extra.step, before);
    before = extra.step;
    expect_within(extra.left_m, 0.0, 100.0);
    expect_within(extra.right_m, 0.0, 100.0);
  }
  for (const std::string& agv_id : grant.waits_for) expect_id(agv_id);
}
void expect_sound(const fleet::SignOff& sign_off) {
  expect_id(sign_off.agv_id);
  if (sign_off.place_in_map) expect_place(*sign_off.place_in_map);
}
void expect_sound(const fleet::TrafficStatus& status) {
  expect_id(status.source_id);
  for (const fleet::WaitingVehicle& waiting : status.waiting) {
    expect_id(waiting.agv_id);
    EXPECT_FALSE(Checks::has_control_characters(waiting.waits_for));
    expect_within(waiting.since_s, 0.0, 1e9);
  }
  EXPECT_LE(status.signed_off.size(), 128U);
  for (const fleet::SilentVehicle& silent : status.silent) {
    expect_id(silent.agv_id);
    expect_place(silent.place_in_map);
  }
  EXPECT_TRUE(std::isfinite(status.slice_ms_p99));
  expect_within(status.share_of_places, 0.0, 1.0);
}
void expect_sound(const fleet::NavigationStatus& status) {
  expect_id(status.agv_id);
  EXPECT_STRNE(name(status.phase), "?");
  EXPECT_STRNE(name(status.reason), "?");
  EXPECT_TRUE(std::isfinite(status.distance_left_m) && std::isfinite(status.time_left_s));
  expect_place(status.blocked_at_in_map);
  expect_within(status.blocked_radius_m, 0.0, 100.0);
  double before_s = 0.0;
  for (const fleet::IntentPoint& point : status.intent) {
    expect_within(point.offset_s, before_s, 3600.0);
    before_s = point.offset_s;
    expect_pose(point.base_in_map);
  }

  expect_within(status.progress_m, 0.0, 1e9);
  expect_within(status.limit_m, 0.0, 1e9);
  expect_within(status.stray_m, 0.0, 1e6);
  EXPECT_LE(status.held.size(), 32U);
  std::uint64_t before = 0;
  for (const fleet::HeldPose& held : status.held) {
    EXPECT_GE(held.step, before);
    before = held.step;
    expect_pose(held.base_in_map);
  }
}
void expect_sound(const fleet::Track& track) {
  expect_place(track.position_in_map);
  expect_within(track.velocity_in_map.x, -100.0, 100.0);
  expect_within(track.velocity_in_map.y, -100.0, 100.0);
  expect_within(track.radius_m, 0.0, 100.0);
  for (const double entry : track.covariance) EXPECT_TRUE(std::isfinite(entry));
}
void expect_sound(const fleet::TrackingStatus& status) {
  expect_id(status.source_id);
  for (const fleet::ScanUse& use : status.newest_scans) expect_id(use.agv_id);
}
void expect_sound(const fleet::CoverageTile& tile) {
  expect_id(tile.source_id);
  expect_place(tile.low_in_map);
  expect_within(tile.cell_m, 1e-3, 100.0);
  expect_within(tile.age_step_s, 1e-3, 3600.0);
  EXPECT_EQ(tile.ages.size(), static_cast<std::size_t>(tile.width_cells) * static_cast<std::size_t>(tile.height_cells));
}
void expect_sound(const fleet::VelocityCommand& command) {
  expect_id(command.agv_id);
  expect_twist(command.twist);
}
void expect_sound(const fleet::Obstacle& obstacle) {
  expect_id(obstacle.id);
  expect_pose(obstacle.base_in_map);
  expect_within(geometry::reach_m(obstacle.footprint), 0.0, 2500.0);
  expect_within(geometry::norm(obstacle.velocity_in_map), 0.0, 142.0);
}
void expect_sound(const fleet::ServiceHealth& health) {
  expect_id(health.instance_id);
  EXPECT_STRNE(name(health.state), "unknown");
  EXPECT_LE(health.counters.size(), 32U);
  EXPECT_TRUE(std::isfinite(health.cpu_percent) && std::isfinite(health.resident_mb));
}
void expect_sound(const fleet::MapEdit& edit) {
  expect_id(edit.edit_id);
  expect_within(static_cast<double>(edit.points_in_map.size()), 1.0, 64.0);
  for (const geometry::Point2 point : edit.points_in_map) expect_place(point);
  expect_within(edit.radius_m, -1e6, 1e6);
}
void expect_sound(const fleet::MapEditResult& result) { expect_id(result.edit_id); }
void expect_sound(const fleet::ZoneEdit& edit) {
  expect_id(edit.edit_id);
  expect_id(edit.zone.id);
  if (edit.action == fleet::ZoneEdit::Action::kAdd) {
    EXPECT_EQ(fleet::refusal_of(edit.zone), "");
  }
}
void expect_sound(const fleet::MapZones& zones) {
  expect_id(zones.map_id);
  for (const fleet::Zone& zone : zones.zones) EXPECT_EQ(fleet::refusal_of(zone), "");
}
void expect_sound(const fleet::MapRequest& request) { expect_id(request.requester_id); }
void expect_sound(const grid::MapSummary& summary) {
  expect_id(summary.map_id);
  expect_within(summary.tiling.geometry.resolution_m, 1e-4, 1e3);
  EXPECT_EQ(summary.tile_hashes.size(), static_cast<std::size_t>(summary.tiling.count()));
}
void expect_sound(const grid::Tile& tile) { EXPECT_FALSE(tile.cells.empty()); }

/// Numbers that are the edges of something, or of nothing.
std::uint64_t nasty(std::mt19937_64& random) {
  static const std::vector<double> doubles{0.0,  -0.0,  1.0,   -1.0, 1e-300, 1e300, 1e6,  -1e6, 1e7,
                                           99.9, 100.0, 101.0, 3.2,  7.1,    1e9,   -1e9, 0.5};
  switch (random() % 4) {
    case 0:
      return random();
    case 1:
      return 0x7ff0000000000000ULL | (random() % 2) << 63 | (random() % 2);  // infinities and NaN
    case 2:
      return random() % 20;
    default: {
      const double number = doubles[random() % doubles.size()];
      std::uint64_t bits = 0;
      static_assert(sizeof bits == sizeof number);
      std::memcpy(&bits, &number, sizeof bits);
      return bits;
    }
  }
}

template <class Topic>
class Ranges : public testing::Test {};

TYPED_TEST_SUITE(Ranges, test_support::EveryTopic, test_support::TopicNames);

/// The golden sample's bytes with up to six words replaced, at the places where doubles, counts and enumerators lie.
TYPED_TEST(Ranges, HoldWhateverTheBytesSay) {
  typename TypeParam::Sample golden = sound_sample<typename TypeParam::Sample>();
  const bus::SampleCodec& codec = bus::sample_codec(TypeParam::kName);
  std::vector<std::uint8_t> whole;
  ASSERT_TRUE(codec.encode(&golden, whole));
  std::mt19937_64 random(7);
  int accepted = 0;
  for (int round = 0; round < 20000; ++round) {
    std::vector<std::uint8_t> bytes = whole;
    for (std::uint64_t words = 1 + random() % 6; words > 0; --words) {
      const std::uint64_t word = nasty(random);
      const std::size_t size = random() % 2 == 0 ? 8 : 4;
      const std::size_t at = 4 + 4 * (random() % ((bytes.size() - 4) / 4));
      for (std::size_t i = 0; i < size && at + i < bytes.size(); ++i)
        bytes[at + i] = static_cast<std::uint8_t>(word >> (8 * i));
    }
    typename TypeParam::Sample sample;
    if (!codec.decode(bytes, &sample)) continue;
    const auto value = decode(sample);
    EXPECT_EQ(static_cast<bool>(value), value.reason().empty());
    if (!value) continue;
    ++accepted;
    expect_sound(*value);
    if (this->HasFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(accepted, 100) << "the bytes were spoiled so much that nothing was looked at";
}

}  // namespace
}  // namespace aisle::wire
