#include "common/service/agv_ids.hpp"

#include <gtest/gtest.h>

#include "common/config/reader.hpp"

namespace aisle::service {
namespace {

using Ids = std::vector<std::string>;

std::string refusal(const std::string& ids) {
  try {
    split_ids("--agv", ids);
  } catch (const config::BadInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(AgvIds, AreSeparatedByCommasAndKeepTheirOrder) {
  EXPECT_EQ(split_ids("--agv", "agv-1"), Ids{"agv-1"});
  EXPECT_EQ(split_ids("--agv", "b,a.2,c_3"), (Ids{"b", "a.2", "c_3"}));
}

TEST(AgvIds, WhatIsNoListOfIdsIsRefusedByName) {
  EXPECT_EQ(refusal(""), "--agv is missing: the id of the vehicle, e.g. agv-1 (or AISLE_AGV)");
  EXPECT_EQ(refusal("a,b,a"), "--agv: 'a' is there twice");
  EXPECT_EQ(refusal("a, b"), "--agv: ' b' is not an id; use 1 to 64 letters, digits, '-', '_' and '.'");
  EXPECT_EQ(refusal("a,,b"), "--agv: '' is not an id; use 1 to 64 letters, digits, '-', '_' and '.'");
  EXPECT_EQ(refusal("a,"), "--agv: '' is not an id; use 1 to 64 letters, digits, '-', '_' and '.'");
  EXPECT_EQ(refusal(std::string(65, 'a')),
            "--agv: '" + std::string(65, 'a') + "' is not an id; use 1 to 64 letters, digits, '-', '_' and '.'");
}

}  // namespace
}  // namespace aisle::service
