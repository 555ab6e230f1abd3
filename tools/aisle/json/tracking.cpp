#include "tools/aisle/json/parts.hpp"

namespace aisle::cli {
namespace {

Json json_of_use(const aisle::ScanUse& use) {
  return Json{{"agv_id", use.agv_id().to_string()}, {"scan_sequence", use.scan_sequence()}, {"scan_stamp_ns", use.scan_stamp_ns()}};
}

}  // namespace

Json to_json(const aisle::Track& sample) {
  return Json{{"track_id", sample.track_id()},
              {"by", to_json(sample.by())},
              {"scan_stamp_ns", sample.scan_stamp_ns()},
              {"position_in_map", to_json(sample.position_in_map())},
              {"velocity_x_mps", sample.velocity_x_mps()},
              {"velocity_y_mps", sample.velocity_y_mps()},
              {"covariance", sample.covariance()},
              {"radius_m", sample.radius_m()},
              {"age_s", sample.age_s()},
              {"unseen_s", sample.unseen_s()},
              {"is_static", sample.is_static()}};
}

Json to_json(const aisle::TrackingStatus& sample) {
  Json scans = Json::array();
  for (const aisle::ScanUse& use : sample.newest_scans()) scans.push_back(json_of_use(use));
  return Json{{"source_id", sample.source_id().to_string()},
              {"by", to_json(sample.by())},
              {"newest_scans", std::move(scans)},
              {"live_track_ids", sample.live_track_ids()},
              {"scans_used", sample.scans_used()},
              {"scans_dropped", sample.scans_dropped()},
              {"processing_ms", sample.processing_ms()}};
}

}  // namespace aisle::cli
