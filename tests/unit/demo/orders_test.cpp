#include "tools/demo/orders.hpp"

#include <gmock/gmock.h>

#include "common/config/reader.hpp"

namespace aisle::demo {
namespace {

using ::testing::HasSubstr;

std::string error_of(const std::string& text) {
  try {
    parse_kill(text);
  } catch (const config::BadInput& error) {
    return error.what();
  }
  return {};
}

TEST(Orders, ReadAKill) {
  const KillOrder order = parse_kill("local-planner-agv-1@12.5");
  EXPECT_EQ(order.service, "local-planner-agv-1");
  EXPECT_DOUBLE_EQ(order.at_s, 12.5);
  EXPECT_DOUBLE_EQ(order.restart_after_s, 1.0);
  EXPECT_DOUBLE_EQ(parse_kill("map@3:0.2").restart_after_s, 0.2);
  EXPECT_DOUBLE_EQ(parse_delay("map@3").until_s, 3.0);
}

TEST(Orders, RefuseWhatIsNoKillAndSayTheForm) {
  for (const char* text : {"map", "@3", "map@", "map@x", "map@-1", "map@3:", "map@3:x", "map@nan", "map@1e99"}) {
    EXPECT_THAT(error_of(text), HasSubstr("SERVICE@SECONDS[:RESTART_AFTER_S]")) << text;
  }
  EXPECT_THROW(parse_delay("map@3:1"), config::BadInput);
}

TEST(Orders, MeanOneInstanceOrAllOfAService) {
  EXPECT_TRUE(means("map", "map"));
  EXPECT_TRUE(means("local-planner", "local-planner-agv-1"));
  EXPECT_FALSE(means("local-planner-agv-1", "local-planner-agv-10"));
  EXPECT_FALSE(means("local", "localised"));
}

TEST(Orders, NameTheNearestProcess) {
  EXPECT_NO_THROW(require_known("local-planner", {"map", "local-planner-agv-1"}));
  try {
    require_known("mop", {"map", "dispatcher"});
    FAIL();
  } catch (const config::BadInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'map'"));
  }
}

}  // namespace
}  // namespace aisle::demo
