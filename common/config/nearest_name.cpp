#include "common/config/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace aisle::config {
namespace {

/// Levenshtein distance in one row (Wagner, Fischer 1974): least number of letters replaced, added or
/// left out.
///
///     d(i, j) = min(d(i-1, j-1) + (a_i != b_j), d(i-1, j) + 1, d(i, j-1) + 1)
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});

  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;

    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }

  return row.back();
}

}  // namespace

/// A name of which every letter would be replaced is no match.
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates) {
  constexpr std::size_t kLongestName = 256;
  if (name.size() > kLongestName) return {};

  std::string best;
  std::size_t best_edits = kLongestName;

  for (const std::string& candidate : candidates) {
    const std::size_t distance = edits(name, candidate);
    const std::size_t allowed = std::max<std::size_t>(2, std::max(name.size(), candidate.size()) / 3);

    if (distance <= allowed && distance < candidate.size() && distance < best_edits) {
      best = candidate;
      best_edits = distance;
    }
  }

  return best;
}

}  // namespace aisle::config
