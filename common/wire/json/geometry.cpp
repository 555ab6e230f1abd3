#include "common/wire/json/json.hpp"

namespace aisle::wire {

Json to_json(const aisle::Point& sample) { return Json{{"x_m", sample.x_m()}, {"y_m", sample.y_m()}}; }

Json to_json(const aisle::Pose& sample) {
  return Json{{"x_m", sample.x_m()}, {"y_m", sample.y_m()}, {"yaw_rad", sample.yaw_rad()}};
}

Json to_json(const aisle::Twist& sample) {
  return Json{{"linear_mps", sample.linear_mps()},
              {"angular_radps", sample.angular_radps()},
              {"sideways_mps", sample.sideways_mps()}};
}

Json to_json(const aisle::Origin& sample) {
  return Json{{"source_id", sample.source_id().to_string()},
              {"boot_id", sample.boot_id()},
              {"epoch", sample.epoch()},
              {"sequence_number", sample.sequence_number()},
              {"stamp_ns", sample.stamp_ns()}};
}

std::string write_json(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace aisle::wire
