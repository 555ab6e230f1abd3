#include "tools/demo/domain_lock.hpp"

#include <gtest/gtest.h>

#include "common/config/reader.hpp"

namespace aisle::demo {
namespace {

TEST(DomainLock, GivesTwoRunsTwoDomains) {
  const DomainLock one = DomainLock::take_any(4711);
  const DomainLock other = DomainLock::take_any(4711);
  EXPECT_NE(one.domain(), other.domain());
  for (const int domain : {one.domain(), other.domain()}) {
    EXPECT_GE(domain, 100);
    EXPECT_LE(domain, 200);
  }
}

TEST(DomainLock, RefusesADomainThatIsTakenUntilItIsFree) {
  int domain = 0;
  {
    const DomainLock one = DomainLock::take_any(99);
    domain = one.domain();
    EXPECT_THROW(DomainLock::take(domain), config::BadEnvironment);
  }
  EXPECT_EQ(DomainLock::take(domain).domain(), domain);
}

}  // namespace
}  // namespace aisle::demo
