// What each codec refuses: the golden sample with one field spoiled at a time. tests/data/refusals/<topic>.txt has a
// line a field. AISLE_UPDATE_GOLDEN=1 build/tests/wire_test writes them; what has changed is then read in the diff.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/bus/topics.hpp"
#include "common/wire/codecs.hpp"
#include "common/wire/field_kind.hpp"
#include "idl/fields.hpp"
#include "tests/support/every_topic.hpp"
#include "tests/support/places.hpp"
#include "tests/unit/wire/sound_samples.hpp"

namespace aisle::wire {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A value put into a field, and what the table calls it.
template <class Field>
struct Probe {
  std::string name;
  Field value;
};

/// What a field is set to. Of a field that holds others: none.
template <class Field>
std::vector<Probe<Field>> probes_of(const Field& sound) {
  std::vector<Probe<Field>> probes;
  if constexpr (std::is_floating_point_v<Field>) {
    for (const char* value :
         {"nan", "-inf", "-1e7", "-1001", "-101", "-3.2", "-0.1", "0", "0.1", "3.2", "101", "1001", "1e7", "inf"}) {
      probes.push_back({value, static_cast<Field>(std::strtod(value, nullptr))});
    }
  } else if constexpr (std::is_integral_v<Field> && !std::is_same_v<Field, bool>) {
    using Limits = std::numeric_limits<Field>;
    if (Limits::is_signed) probes.push_back({"lowest", Limits::lowest()});
    for (const int value : {0, 1}) probes.push_back({std::to_string(value), static_cast<Field>(value)});
    probes.push_back({"highest", Limits::max()});
  } else if constexpr (std::is_enum_v<Field>) {
    const auto words = idl::words_of(Field{});
    for (std::size_t i = 0; i < words.size(); ++i) probes.push_back({words[i], static_cast<Field>(i)});
    for (const int value : {-1, static_cast<int>(words.size())})
      probes.push_back({"no_enumerator", static_cast<Field>(value)});
  } else if constexpr (IsText<Field>::value) {
    probes = {{"empty", Field("")}, {"newline", Field("a\nb")}, {"delete", Field("\x7f")}, {"text", Field("a-1")}};
  } else if constexpr (IsSequence<Field>::value && !std::is_aggregate_v<Field>) {
    Field shorter = sound, longer = sound;
    if (!sound.empty()) {
      shorter.pop_back();
      longer.push_back(sound.back());
    }
    probes = {{"empty", Field{}}, {"one_less", shorter}, {"one_more", longer}};
  }
  return probes;
}

/// Spoils each field of a sample in turn, decodes the sample, and notes what came of it.
template <class Sample>
class RefusalTable {
 public:
  explicit RefusalTable(Sample sound) : sample_(std::move(sound)) {
    idl::visit_fields(sample_, [this](const char* name, auto& field) {
      if (std::string(name) != "by") this->look_at(name, name, field);  // decoders leave the origin to origin_of()
    });
  }
  const std::string& text() const { return text_; }

 private:
  /// `top` is the sample's own field that `field` is, or lies in.
  template <class Field>
  void look_at(const std::string& path, const std::string& top, Field& field) {
    const Field sound = field;
    std::string refused, taken;
    for (const Probe<Field>& probe : probes_of(sound)) {
      field = probe.value;
      const auto value = decode(sample_);
      if (value) {
        EXPECT_NE(probe.name, "no_enumerator") << path;
        taken += " " + probe.name;
      } else {
        refused += " " + probe.name;
        const std::string reason = value.reason().substr(0, value.reason().find(' '));
        if (reason.rfind(top, 0) != 0) refused += "(" + reason + ")";
      }
      field = sound;
    }
    if (!refused.empty() || !taken.empty())
      text_ += path + ": refuses" + or_nothing(refused) + "; takes" + or_nothing(taken) + "\n";
    look_inside(path, top, field);
  }

  /// Of a sequence, its last element.
  template <class Field>
  void look_inside(const std::string& path, const std::string& top, Field& field) {
    if constexpr (IsText<Field>::value) {
    } else if constexpr (IsSequence<Field>::value) {
      if (!field.empty()) look_at(path + "[]", top, field.back());
    } else if constexpr (std::is_class_v<Field>) {
      idl::visit_fields(field, [&](const char* name, auto& inner) { look_at(path + "." + name, top, inner); });
    }
  }

  static std::string or_nothing(const std::string& list) { return list.empty() ? " nothing" : list; }

  Sample sample_;
  std::string text_;
};

template <class Topic>
class RefusalsOf : public testing::Test {};

TYPED_TEST_SUITE(RefusalsOf, test_support::EveryTopic, test_support::TopicNames);

TYPED_TEST(RefusalsOf, EachFieldAreThoseOfItsTable) {
  auto sample = sound_sample<typename TypeParam::Sample>();
  ASSERT_EQ(decode(sample).reason(), "");
  const std::string table = RefusalTable<typename TypeParam::Sample>(sample).text();

  const std::filesystem::path folder = test_support::source_folder() / "tests" / "data" / "refusals";
  const std::filesystem::path file = folder / (std::string(TypeParam::kName) + ".txt");
  if (std::getenv("AISLE_UPDATE_GOLDEN") != nullptr) std::ofstream(file) << table;
  std::ifstream in(file);
  EXPECT_EQ(table, (std::string{std::istreambuf_iterator<char>(in), {}})) << file;
}

TEST(Refusals, OfAPlanThatWasFoundButHasNoWay) {
  auto plan = sound_sample<aisle::Plan>();
  plan.outcome(PlanOutcome::PLAN_FOUND);
  ASSERT_EQ(decode(plan).reason(), "");
  plan.waypoints_in_map().clear();
  EXPECT_EQ(decode(plan).reason().rfind("waypoints_in_map has 0", 0), 0U) << decode(plan).reason();
}

TEST(Refusals, OfAnIntentThatGoesBackInTime) {
  auto status = sound_sample<aisle::NavigationStatus>();
  status.intent().push_back(IntentPoint{});
  EXPECT_EQ(decode(status).reason().rfind("intent.offset_s", 0), 0U) << decode(status).reason();
}

TEST(Refusals, OfAPlanWhoseStepsGoBack) {
  auto plan = sound_sample<aisle::Plan>();
  plan.step_ends_m({3.0, 2.0});
  EXPECT_EQ(decode(plan).reason().rfind("step_ends_m = 2", 0), 0U) << decode(plan).reason();
}

TEST(Refusals, OfAPlanWithStepsAndNoWay) {
  auto plan = sound_sample<aisle::Plan>();
  plan.waypoints_in_map().clear();
  plan.headings_rad().clear();
  EXPECT_EQ(decode(plan).reason().rfind("step_ends_m has 2", 0), 0U) << decode(plan).reason();
  plan.step_ends_m().clear();
  plan.own_steps().clear();
  EXPECT_EQ(decode(plan).reason(), "");
}

TEST(Refusals, OfAPlanWithAHeadingForSomeOfItsWaypoints) {
  auto plan = sound_sample<aisle::Plan>();
  plan.headings_rad().pop_back();
  EXPECT_EQ(decode(plan).reason().rfind("headings_rad has 1", 0), 0U) << decode(plan).reason();
  plan.headings_rad().clear();
  EXPECT_EQ(decode(plan).reason(), "");
}

TEST(Refusals, OfAPlanThatTellsOwnFromRoadmapForSomeOfItsSteps) {
  auto plan = sound_sample<aisle::Plan>();
  plan.own_steps().pop_back();
  EXPECT_EQ(decode(plan).reason().rfind("own_steps has 1", 0), 0U) << decode(plan).reason();
}

TEST(Refusals, OfHeldPosesWhoseStepsGoBack) {
  auto status = sound_sample<aisle::NavigationStatus>();
  status.held().push_back(status.held().front());
  EXPECT_EQ(decode(status).reason(), "held.step falls");
}

TEST(Refusals, OfExtraWidthsWhoseStepsGoBack) {
  auto grant = sound_sample<aisle::Grant>();
  grant.extra().push_back(grant.extra().front());
  EXPECT_EQ(decode(grant).reason(), "extra.step falls");
}

/// The pose is good without the command.
TEST(Refusals, NotOfAVehicleStateForTheCommandInForce) {
  const std::function<void(aisle::VehicleState&)> spoils[]{
      [](auto& s) { s.command_agv_id(""); },
      [](auto& s) { s.command_agv_id("\n"); },
      [](auto& s) { s.command_by().source_id(""); },
      [](auto& s) { s.command_by().source_id("a\nb"); },
      [](auto& s) { s.command_by().sequence_number(0); },
  };
  const auto sound = sound_sample<aisle::VehicleState>();
  ASSERT_TRUE(decode(sound)->command.has_value());
  for (const auto& spoil : spoils) {
    aisle::VehicleState sample = sound;
    spoil(sample);
    const auto decoded = decode(sample);
    ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
    EXPECT_FALSE(decoded->command.has_value());
    EXPECT_EQ(decoded->accepted_epoch, sound.accepted_epoch());
  }
}

/// It is for people, and drives nothing.
TEST(Refusals, NotOfAVelocityCommandForItsComputingTime) {
  for (const double bad : {kNan, kInfinity}) {
    auto sample = sound_sample<aisle::VelocityCommand>();
    sample.control_ms(bad);
    const auto decoded = decode(sample);
    ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
    EXPECT_EQ(decoded->control_ms, 0.0);
  }
}

}  // namespace
}  // namespace aisle::wire
