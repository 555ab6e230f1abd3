#include "common/wire/tracking.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/wire/geometry.hpp"

namespace aisle::wire {
namespace {

// Sizes are those of the IDL.
constexpr std::size_t kMostScans = 256;
constexpr std::size_t kMostTracks = 1024;
constexpr std::size_t kMostCells = 4096;
constexpr double kLargestRadiusM = 100.0;
constexpr double kSmallestCellM = 1e-3;
constexpr double kLargestCellM = 100.0;
constexpr double kShortestStepS = 1e-3;
constexpr double kLongestStepS = 3600.0;

}  // namespace

aisle::Track encode(const fleet::Track& track) {
  aisle::Track sample;
  sample.track_id(track.id);
  sample.scan_stamp_ns(track.scan_stamp_ns);

  sample.position_in_map(encode(track.position_in_map));
  sample.velocity_x_mps(track.velocity_in_map.x);
  sample.velocity_y_mps(track.velocity_in_map.y);
  sample.covariance(track.covariance);

  sample.radius_m(track.radius_m);
  sample.age_s(track.age_s);
  sample.unseen_s(track.unseen_s);
  sample.is_static(track.is_static);

  return sample;
}

Decoded<fleet::Track> decode(const aisle::Track& sample) {
  Checks checks;
  fleet::Track track;

  track.id = sample.track_id();

  track.position_in_map = decode(sample.position_in_map(), checks, "position_in_map");
  track.velocity_in_map = {sample.velocity_x_mps(), sample.velocity_y_mps()};

  track.radius_m = sample.radius_m();
  track.age_s = sample.age_s();
  track.unseen_s = sample.unseen_s();
  track.is_static = sample.is_static();
  track.scan_stamp_ns = sample.scan_stamp_ns();

  checks.within("velocity_x_mps", sample.velocity_x_mps(), -kFastestMps, kFastestMps)
      .within("velocity_y_mps", sample.velocity_y_mps(), -kFastestMps, kFastestMps)
      .within("radius_m", sample.radius_m(), 0.0, kLargestRadiusM)
      .finite("age_s", sample.age_s())
      .finite("unseen_s", sample.unseen_s());

  for (std::size_t i = 0; i < track.covariance.size(); ++i) {
    track.covariance[i] = sample.covariance()[i];
    checks.finite("covariance", track.covariance[i]);
  }

  return checks.decoded(track);
}

aisle::TrackingStatus encode(const fleet::TrackingStatus& status) {
  aisle::TrackingStatus sample;
  sample.source_id(status.source_id);

  for (const fleet::ScanUse& scan : status.newest_scans) {
    aisle::ScanUse use;
    use.agv_id(scan.agv_id);
    use.scan_sequence(scan.scan_sequence);
    use.scan_stamp_ns(scan.scan_stamp_ns);
    sample.newest_scans().push_back(use);
  }

  sample.live_track_ids(status.live_track_ids);
  sample.scans_used(status.scans_used);
  sample.scans_dropped(status.scans_dropped);
  sample.processing_ms(status.processing_ms);

  return sample;
}

Decoded<fleet::TrackingStatus> decode(const aisle::TrackingStatus& sample) {
  Checks checks;
  fleet::TrackingStatus status;

  status.source_id = sample.source_id().to_string();
  status.scans_used = sample.scans_used();
  status.scans_dropped = sample.scans_dropped();
  status.processing_ms = sample.processing_ms();

  checks.id("source_id", status.source_id)
      .finite("processing_ms", status.processing_ms)
      .count("newest_scans", sample.newest_scans().size(), 0, kMostScans)
      .count("live_track_ids", sample.live_track_ids().size(), 0, kMostTracks);

  if (!checks.ok()) return Decoded<fleet::TrackingStatus>::refused(checks.reason());

  for (const aisle::ScanUse& use : sample.newest_scans()) {
    status.newest_scans.push_back({use.agv_id().to_string(), use.scan_sequence(), use.scan_stamp_ns()});
    checks.id("newest_scans.agv_id", status.newest_scans.back().agv_id);
  }

  status.live_track_ids = sample.live_track_ids();
  return checks.decoded(std::move(status));
}

aisle::Coverage encode(const fleet::CoverageTile& tile) {
  aisle::Coverage sample;
  sample.source_id(tile.source_id);
  sample.map_id(tile.map_id);
  sample.tile_x(tile.tile_x);
  sample.tile_y(tile.tile_y);

  sample.low_in_map(encode(tile.low_in_map));
  sample.cell_m(tile.cell_m);
  sample.width_cells(static_cast<std::uint32_t>(tile.width_cells));
  sample.height_cells(static_cast<std::uint32_t>(tile.height_cells));

  sample.age_step_s(tile.age_step_s);
  sample.ages(tile.ages);

  return sample;
}

/// As many ages as cells.
Decoded<fleet::CoverageTile> decode(const aisle::Coverage& sample) {
  Checks checks;
  fleet::CoverageTile tile;

  tile.source_id = sample.source_id().to_string();
  tile.map_id = sample.map_id().to_string();
  tile.tile_x = sample.tile_x();
  tile.tile_y = sample.tile_y();

  tile.low_in_map = decode(sample.low_in_map(), checks, "low_in_map");
  tile.cell_m = sample.cell_m();
  tile.age_step_s = sample.age_step_s();

  checks.id("source_id", tile.source_id)
      .optional_id("map_id", tile.map_id)
      .within("cell_m", tile.cell_m, kSmallestCellM, kLargestCellM)
      .within("age_step_s", tile.age_step_s, kShortestStepS, kLongestStepS)
      .within("width_cells", sample.width_cells(), 1.0, kMostCells)
      .within("height_cells", sample.height_cells(), 1.0, kMostCells);

  if (!checks.ok()) return Decoded<fleet::CoverageTile>::refused(checks.reason());

  tile.width_cells = static_cast<int>(sample.width_cells());
  tile.height_cells = static_cast<int>(sample.height_cells());

  const std::size_t cells = static_cast<std::size_t>(sample.width_cells()) * sample.height_cells();
  checks.count("ages", sample.ages().size(), cells, cells);
  if (checks.ok()) tile.ages.assign(sample.ages().begin(), sample.ages().end());

  return checks.decoded(std::move(tile));
}

Extras extras_of(const aisle::Coverage& sample) {
  const std::vector<std::uint8_t>& ages = sample.ages();
  const auto count = [&](char letter) {
    return std::count_if(ages.begin(), ages.end(),
                         [&](std::uint8_t age) { return fleet::letter_of_age(age, sample.age_step_s()) == letter; });
  };
  return {{"cells_seen_in_1_s", count('#')},
          {"cells_never_seen", count(' ')},
          {"picture", fleet::picture_of(ages, sample.width_cells(), sample.height_cells(), sample.age_step_s())}};
}

}  // namespace aisle::wire
