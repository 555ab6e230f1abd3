#pragma once
// The one line that bad input gets.
#include <string>

#include "common/config/reader.hpp"

namespace aisle::test_support {

/// The message of the BadInput that `action` throws; "accepted" when it throws none.
template <class Action>
std::string refusal_of(Action action) {
  try {
    action();
  } catch (const config::BadInput& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace aisle::test_support
