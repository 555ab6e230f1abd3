// The wire is a contract: the bytes of a sample of each type are kept in tests/data/cdr, beside what its fields are,
// and every release of ours and of the middleware must write and read the same. For a new topic, and after an intended
// change of the IDL, AISLE_UPDATE_GOLDEN=1 build/tests/bus_test writes the files that are no longer right.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "common/bus/sample_codec.hpp"
#include "common/wire/json/json.hpp"
#include "tests/support/every_topic.hpp"
#include "tests/unit/bus/filled_sample.hpp"
#include "tests/unit/bus/golden_samples.hpp"

namespace aisle::bus_test {
namespace {

bool may_update() { return std::getenv("AISLE_UPDATE_GOLDEN") != nullptr; }

std::string read(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

template <class Topic>
class GoldenBytes : public testing::Test {
 protected:
  using Sample = typename Topic::Sample;

  static void SetUpTestSuite() {
    const bus::SampleCodec& codec = bus::sample_codec(Topic::kName);
    Sample sample;
    if (!may_update() || codec.decode(read_golden_bytes(Topic::kName), &sample)) return;
    sample = filled_sample<Sample>();
    Bytes bytes;
    if (codec.encode(&sample, bytes)) std::ofstream(golden_file(Topic::kName)) << hex(bytes);
  }

  const bus::SampleCodec& codec_{bus::sample_codec(Topic::kName)};
  const Bytes golden_{read_golden_bytes(Topic::kName)};
};

TYPED_TEST_SUITE(GoldenBytes, test_support::EveryTopic, test_support::TopicNames);

TYPED_TEST(GoldenBytes, AreReadAndWrittenAgain) {
  typename TypeParam::Sample sample;
  ASSERT_TRUE(this->codec_.decode(this->golden_, &sample)) << golden_file(TypeParam::kName);
  EXPECT_FALSE(sample == typename TypeParam::Sample{});
  Bytes bytes;
  ASSERT_TRUE(this->codec_.encode(&sample, bytes));
  EXPECT_EQ(hex(bytes), hex(this->golden_));
}

/// Two fields of a type that change places leave the bytes readable; they mean something else.
TYPED_TEST(GoldenBytes, MeanTheSameAsEver) {
  const std::string json = wire::to_json(golden_sample<typename TypeParam::Sample>()).dump(2) + "\n";
  const std::filesystem::path file = golden_file(TypeParam::kName, "json");
  if (may_update()) std::ofstream(file) << json;
  EXPECT_EQ(json, read(file)) << file;
}

/// What the golden bytes of a new topic are made of.
TYPED_TEST(GoldenBytes, OfASampleFilledByItsFieldsAreReadBack) {
  const auto sample = filled_sample<typename TypeParam::Sample>();
  EXPECT_FALSE(sample == typename TypeParam::Sample{});
  Bytes bytes;
  ASSERT_TRUE(this->codec_.encode(&sample, bytes));
  typename TypeParam::Sample read;
  ASSERT_TRUE(this->codec_.decode(bytes, &read));
  EXPECT_EQ(read, sample);
}

/// Empty sequences: what stands after them begins without the alignment that their elements would need.
TYPED_TEST(GoldenBytes, OfASampleWithDefaultValuesAreReadBack) {
  const typename TypeParam::Sample sample;
  Bytes bytes;
  ASSERT_TRUE(this->codec_.encode(&sample, bytes));
  typename TypeParam::Sample read;
  EXPECT_TRUE(this->codec_.decode(bytes, &read));

  bytes.resize(bytes.size() + 4);
  EXPECT_FALSE(this->codec_.decode(bytes, &read)) << "with four bytes more";
}

TYPED_TEST(GoldenBytes, CutAnywhereNeverThrowAndNeverPassForTheSample) {
  const Bytes& whole = this->golden_;
  for (std::size_t length = 0; length + 3 < whole.size(); ++length) {
    typename TypeParam::Sample read;
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_FALSE(this->codec_.decode(cut, &read)) << "cut at byte " << length;
    EXPECT_EQ(read, typename TypeParam::Sample{}) << "cut at byte " << length;
  }
}

TYPED_TEST(GoldenBytes, OfATypeWithAFieldMoreDoNotPass) {
  Bytes longer = this->golden_;
  longer.resize(longer.size() + 8);
  typename TypeParam::Sample read;
  EXPECT_FALSE(this->codec_.decode(longer, &read));
}

TYPED_TEST(GoldenBytes, WithALyingLengthAnywhereNeverThrow) {
  const Bytes& whole = this->golden_;
  for (std::size_t at = 4; at + 4 <= whole.size(); at += 4) {
    typename TypeParam::Sample read;
    Bytes lying = whole;
    for (std::size_t i = 0; i < 4; ++i) lying[at + i] = 0xff;
    EXPECT_NO_THROW(this->codec_.decode(lying, &read)) << "at byte " << at;
  }
}

}  // namespace
}  // namespace aisle::bus_test
