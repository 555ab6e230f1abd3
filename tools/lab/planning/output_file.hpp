#pragma once
#include "common/process/output_file.hpp"

namespace aisle::cli {

using process::check_writable;
using process::write_output_file;

}  // namespace aisle::cli
