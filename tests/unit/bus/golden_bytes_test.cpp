// The wire is a contract: the bytes of a sample of each type are kept in tests/data/cdr, and every release of ours and
// of the middleware must write and read the same. After an intended change of the IDL: AISLE_UPDATE_GOLDEN=1
// build/tests/bus_test.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "common/bus/sample_codec.hpp"
#include "tests/support/places.hpp"
#include "tests/unit/bus/golden_samples.hpp"

namespace aisle::bus_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string golden_file(const std::string& topic) {
  return test_support::source_folder().string() + "/tests/data/cdr/" + topic + ".hex";
}

/// Sixteen bytes a line.
std::string hex(const Bytes& bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    char two[4];
    std::snprintf(two, sizeof two, "%02x%c", bytes[i], i % 16 == 15 || i + 1 == bytes.size() ? '\n' : ' ');
    text += two;
  }
  return text;
}

Bytes read_golden(const std::string& topic) {
  std::ifstream file(golden_file(topic));
  Bytes bytes;
  for (std::string two; file >> two;) bytes.push_back(static_cast<std::uint8_t>(std::stoul(two, nullptr, 16)));
  return bytes;
}

template <class Topic>
class GoldenBytes : public testing::Test {
 protected:
  GoldenBytes() : codec_(bus::sample_codec(Topic::kName)) { fill(sample_); }
  const bus::SampleCodec& codec_;
  typename Topic::Sample sample_;
};

template <class List>
struct Types;
template <class... Topics>
struct Types<topics::List<Topics...>> {
  using type = testing::Types<Topics...>;
};
struct Names {
  template <class Topic>
  static std::string GetName(int) {
    return Topic::kName;
  }
};
TYPED_TEST_SUITE(GoldenBytes, Types<topics::All>::type, Names);

TYPED_TEST(GoldenBytes, AreWritten) {
  Bytes bytes;
  ASSERT_TRUE(this->codec_.encode(&this->sample_, bytes));
  if (std::getenv("AISLE_UPDATE_GOLDEN") != nullptr) std::ofstream(golden_file(TypeParam::kName)) << hex(bytes);
  EXPECT_EQ(hex(bytes), hex(read_golden(TypeParam::kName)));
}

TYPED_TEST(GoldenBytes, AreRead) {
  typename TypeParam::Sample read;
  ASSERT_TRUE(this->codec_.decode(read_golden(TypeParam::kName), &read));
  EXPECT_EQ(read, this->sample_);
}

/// What a new topic has before somebody writes a sample of it by hand.
TYPED_TEST(GoldenBytes, OfASampleFilledByItsFieldsAreReadBack) {
  typename TypeParam::Sample sample;
  fill<typename TypeParam::Sample>(sample);
  EXPECT_FALSE(sample == typename TypeParam::Sample{});
  Bytes bytes;
  ASSERT_TRUE(this->codec_.encode(&sample, bytes));
  typename TypeParam::Sample read;
  ASSERT_TRUE(this->codec_.decode(bytes, &read));
  EXPECT_EQ(read, sample);
}

TYPED_TEST(GoldenBytes, CutAnywhereNeverThrowAndNeverPassForTheSample) {
  const Bytes whole = read_golden(TypeParam::kName);
  for (std::size_t length = 0; length + 3 < whole.size(); ++length) {
    typename TypeParam::Sample read;
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_FALSE(this->codec_.decode(cut, &read)) << "cut at byte " << length;
    EXPECT_EQ(read, typename TypeParam::Sample{}) << "cut at byte " << length;
  }
}

TYPED_TEST(GoldenBytes, OfATypeWithAFieldMoreDoNotPass) {
  Bytes longer = read_golden(TypeParam::kName);
  longer.resize(longer.size() + 8);
  typename TypeParam::Sample read;
  EXPECT_FALSE(this->codec_.decode(longer, &read));
}

TYPED_TEST(GoldenBytes, WithALyingLengthAnywhereNeverThrow) {
  const Bytes whole = read_golden(TypeParam::kName);
  for (std::size_t at = 4; at + 4 <= whole.size(); at += 4) {
    typename TypeParam::Sample read;
    Bytes lying = whole;
    for (std::size_t i = 0; i < 4; ++i) lying[at + i] = 0xff;
    EXPECT_NO_THROW(this->codec_.decode(lying, &read)) << "at byte " << at;
  }
}

}  // namespace
}  // namespace aisle::bus_test
