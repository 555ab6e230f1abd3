#include "common/service/agv_ids.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "common/config/reader.hpp"

namespace aisle::service {
namespace {

constexpr std::size_t kLongestId = 64;

}  // namespace

void check_id(const std::string& flag, const std::string& id) {
  const auto is_fit = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.';
  };

  if (id.empty() || id.size() > kLongestId || !std::all_of(id.begin(), id.end(), is_fit)) {
    throw config::BadInput(flag + ": '" + id + "' is not an id; use 1 to 64 letters, digits, '-', '_' and '.'");
  }
}

/// An empty part between two commas is no id.
std::vector<std::string> split_ids(const std::string& flag, const std::string& ids) {
  if (ids.empty()) throw config::BadInput(flag + " is missing: the id of the vehicle, e.g. agv-1 (or AISLE_AGV)");

  std::vector<std::string> found;
  for (std::size_t begin = 0; begin <= ids.size();) {
    const std::size_t end = std::min(ids.find(',', begin), ids.size());
    const std::string id = ids.substr(begin, end - begin);

    check_id(flag, id);

    if (std::find(found.begin(), found.end(), id) != found.end())
      throw config::BadInput(flag + ": '" + id + "' is there twice");

    found.push_back(id);
    begin = end + 1;
  }

  return found;
}

}  // namespace aisle::service
