#pragma once

#include <string>
#include <vector>

namespace aisle::service {

/// The ids of "agv-1,agv-2", in that order. `flag` names the input in errors. @throws config::BadInput
/// when there is none, one twice, or one that is not an id
std::vector<std::string> split_ids(const std::string& flag, const std::string& ids);

/// An id has 1 to 64 letters, digits, '-', '_' and '.'. @throws config::BadInput
void check_id(const std::string& flag, const std::string& id);

}  // namespace aisle::service
