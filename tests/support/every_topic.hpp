#pragma once
// A typed suite over all topics: TYPED_TEST_SUITE(Suite, test_support::EveryTopic, test_support::TopicNames).
#include <gtest/gtest.h>

#include <string>

#include "common/bus/topics.hpp"

namespace aisle::test_support {

template <class List>
struct TypesOf;
template <class... Topics>
struct TypesOf<topics::List<Topics...>> {
  using type = testing::Types<Topics...>;
};

using EveryTopic = TypesOf<topics::All>::type;

struct TopicNames {
  template <class Topic>
  static std::string GetName(int) {
    return Topic::kName;
  }
};

}  // namespace aisle::test_support
