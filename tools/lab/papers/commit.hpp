#pragma once

namespace aisle::lab {

/// The commit that this program was built from, "4c2e91a", with "-dirty" after it when files differed from it;
/// "unknown" when it was built outside a repository.
const char* source_commit();

}  // namespace aisle::lab
