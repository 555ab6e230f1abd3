// Whether this build carries a sanitizer, whose shadow memory counts as resident.
#pragma once

namespace aisle::test_support {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

}  // namespace aisle::test_support
