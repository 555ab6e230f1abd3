#pragma once
// All codecs: wire::decode(sample) and wire::encode(value) for each topic.
#include "common/wire/map.hpp"
#include "common/wire/vehicle_info.hpp"
#include "common/wire/world_obstacle.hpp"
