#pragma once

#include <functional>
#include <string>

namespace aisle::lab {

/// Told what is being worked on, now and then, in one line.
using Progress = std::function<void(const std::string&)>;

}  // namespace aisle::lab
