#pragma once

// JSON as this program prints it.

#include "common/wire/json/json.hpp"

namespace aisle::cli {

using wire::Json;
using wire::json_of;
using wire::to_json;
using wire::write_json;

}  // namespace aisle::cli
