#pragma once

// Every topic's codec: `decode(const Topic::Sample&)` gives Decoded<Value>, `encode(const Value&)` gives the sample,
// found by overload. Code that is written for any topic includes this; code for one topic includes that one's header.

#include "common/wire/map.hpp"
#include "common/wire/origin.hpp"
#include "common/wire/planning.hpp"
#include "common/wire/service.hpp"
#include "common/wire/tracking.hpp"
#include "common/wire/traffic.hpp"
#include "common/wire/vehicle.hpp"
