#pragma once
// The random maps of `aisle experiment`, for tests.
#include "tools/lab/planning/random_maps.hpp"

namespace aisle::test_support {

using lab::random_between;
using lab::random_blocks;
using lab::random_cells;

}  // namespace aisle::test_support
