#include "services/fake-world/core/recording.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <system_error>
#include <utility>

#include "common/config/reader.hpp"

namespace aisle::fake_world {
namespace {

constexpr std::uintmax_t kLargestBytes = 64u << 20;

using RowsById = std::map<long long, std::vector<RecordedPerson::Row>>;

[[noreturn]] void reject(const std::filesystem::path& file, int line, const std::string& why) {
  throw config::BadInput(file.string() + ":" + std::to_string(line) + ": " + why);
}

/// The rows of each person in the file's order, in seconds and in map. @throws config::BadInput with file:line
RowsById read_rows(const scenario::Recording& recording) {
  std::ifstream in(recording.file);
  if (!in) throw config::BadInput(recording.file.string() + ": cannot be read");

  RowsById people;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream numbers(text);

    // A row is `frame id x y`. Some files write the id as a decimal fraction, so it is read as one.
    double frame = 0.0;
    double id = 0.0;
    geometry::Point2 point;

    if (!(numbers >> frame >> id >> point.x >> point.y))
      reject(recording.file, line, "not a row 'frame id x y': " + text.substr(0, 60));
    if (!std::isfinite(frame) || !geometry::is_finite(point) || std::abs(id) > 1e9)
      reject(recording.file, line, "a number out of all bounds");

    people[std::llround(id)].push_back(
        {frame / recording.frames_per_s, geometry::to_map(recording.frame_in_map, point)});
  }

  return people;
}

}  // namespace

RecordedPerson::RecordedPerson(std::string id, std::vector<Row> rows) : id_(std::move(id)), rows_(std::move(rows)) {}

std::optional<Motion> RecordedPerson::at(double t_s) const {
  if (t_s < rows_.front().t_s || t_s > rows_.back().t_s) return std::nullopt;

  const auto later =
      std::upper_bound(rows_.begin(), rows_.end(), t_s, [](double t, const Row& row) { return t < row.t_s; });

  if (later == rows_.end()) return Motion{rows_.back().in_map, {}};

  // Straight and at constant speed from row a to row b: x(t) = a + (t - t_a) v, v = (b - a) / (t_b - t_a).
  const Row& b = *later;
  const Row& a = *(later - 1);
  const geometry::Point2 velocity = (1.0 / (b.t_s - a.t_s)) * (b.in_map - a.in_map);

  return Motion{a.in_map + (t_s - a.t_s) * velocity, velocity};
}

std::vector<RecordedPerson> read_recording(const scenario::Recording& recording) {
  std::error_code error;
  if (std::filesystem::file_size(recording.file, error) > kLargestBytes && !error) {
    throw config::BadInput(recording.file.string() + ": larger than 64 MiB");
  }

  RowsById people = read_rows(recording);
  if (people.empty()) throw config::BadInput(recording.file.string() + ": no rows 'frame id x y'");

  // The recording's clock starts at the first row of all.
  double first_s = people.begin()->second.front().t_s;
  for (const auto& [id, rows] : people) {
    for (const RecordedPerson::Row& row : rows) first_s = std::min(first_s, row.t_s);
  }

  // Put each person's rows into order of time; keep those who are there in the part that is played.
  std::vector<RecordedPerson> kept;
  for (auto& [id, rows] : people) {
    for (RecordedPerson::Row& row : rows) row.t_s -= first_s;
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.t_s < b.t_s; });

    const bool is_there = rows.back().t_s >= recording.begin_s && rows.front().t_s <= recording.end_s;
    if (is_there) kept.emplace_back(recording.file.stem().string() + "-" + std::to_string(id), std::move(rows));
  }

  return kept;
}

}  // namespace aisle::fake_world
