// What every codec must do, whatever its topic: the sample of the golden bytes, decoded and encoded again, is the same
// sample; a number that is no enumerator, an empty key and a number that is not finite are refused.
#include "common/wire/codecs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/bus/topics.hpp"
#include "tests/support/every_topic.hpp"
#include "tests/unit/wire/sound_samples.hpp"

namespace aisle::wire {
namespace {

template <class Topic>
class Codecs : public testing::Test {};

TYPED_TEST_SUITE(Codecs, test_support::EveryTopic, test_support::TopicNames);

TYPED_TEST(Codecs, EncodeWhatTheyDecodeToTheSameSample) {
  using Sample = typename TypeParam::Sample;
  const Sample sample = sound_sample<Sample>();
  const auto value = decode(sample);
  ASSERT_TRUE(static_cast<bool>(value)) << value.reason();

  Sample again = encode(*value);
  stamp(again, origin_of(sample));
  EXPECT_EQ(again, sample);
}

TEST(Origin, OfASampleIsWhatItSays) {
  const fleet::Origin origin = origin_of(sound_sample<aisle::Plan>());
  EXPECT_EQ(origin, (fleet::Origin{"planner-1", 0x1122334455667788U, 3, 4711, 1700000000123456789}));
}

TEST(Origin, OfATypeWithoutOneSaysNothing) { EXPECT_EQ(origin_of(sound_sample<aisle::MapTile>()), fleet::Origin{}); }

TEST(Origin, WithControlCharactersCountsAsNone) {
  aisle::Goal sample = sound_sample<aisle::Goal>();
  sample.by().source_id("planner\n1");
  EXPECT_EQ(origin_of(sample).source_id, "");
}

TEST(VehicleStateCodec, KnowsNoCommandBeforeTheFirst) {
  fleet::VehicleState state;
  state.agv_id = "agv-1";
  const auto decoded = decode(encode(state));
  ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
  EXPECT_FALSE(decoded->command.has_value());
  EXPECT_EQ(decoded->hold, fleet::Hold::kNoCommand);
}

}  // namespace
}  // namespace aisle::wire
