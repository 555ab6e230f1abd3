#include "services/dispatcher/core/edit_schedule.hpp"

#include <gtest/gtest.h>

namespace aisle::dispatcher {
namespace {

using std::chrono::milliseconds;

scenario::Scenario yard() {
  scenario::Scenario scenario;
  scenario.name = "yard";
  scenario.map_edits = {{10.0, true, {1, 1}, {2, 3}}, {20.0, false, {1, 1}, {2, 3}}};
  return scenario;
}

TEST(EditSchedule, SendsAtItsTimeAndAgainUntilAnswered) {
  EditSchedule schedule(yard(), {});
  EXPECT_TRUE(schedule.due(9.9, "hall", milliseconds(0)).empty());
  EXPECT_TRUE(schedule.due(10.0, "", milliseconds(100)).empty()) << "the map is not known";
  const auto first = schedule.due(10.1, "hall", milliseconds(200));
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].map_id, "hall");
  EXPECT_EQ(first[0].action, fleet::MapEdit::Action::kBlock);
  EXPECT_EQ(first[0].points_in_map.at(1), (geometry::Point2{2, 3}));
  EXPECT_TRUE(schedule.due(10.2, "hall", milliseconds(300)).empty());
  const auto again = schedule.due(10.7, "hall", milliseconds(800));
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].edit_id, first[0].edit_id);
  EXPECT_TRUE(schedule.answered(first[0].edit_id));
  EXPECT_FALSE(schedule.answered(first[0].edit_id));
  EXPECT_TRUE(schedule.due(15.0, "hall", milliseconds(5000)).empty());
  EXPECT_FALSE(schedule.all_done());
}

TEST(EditSchedule, DoesNotRepeatAfterARestartWhatWasAnswered) {
  EditSchedule before(yard(), {});
  const auto edits = before.due(30.0, "hall", milliseconds(0));
  ASSERT_EQ(edits.size(), 2u);
  EXPECT_NE(edits[0].edit_id, edits[1].edit_id);
  before.answered(edits[0].edit_id);
  EditSchedule after(yard(), before.done());
  const auto open = after.due(30.0, "hall", milliseconds(0));
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].action, fleet::MapEdit::Action::kUnblock);
}

}  // namespace
}  // namespace aisle::dispatcher
