#pragma once
// The random maps of `aisle experiment`, for tests.
#include "tools/lab/planning/random_maps.hpp"

namespace aisle::test_support {

using cli::random_between;
using cli::random_blocks;
using cli::random_cells;

}  // namespace aisle::test_support
