#pragma once
#include <functional>
#include <string>

namespace aisle::cli {

/// Told what is being worked on, now and then, in one line.
using Progress = std::function<void(const std::string&)>;

}  // namespace aisle::cli
