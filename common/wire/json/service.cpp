#include "common/wire/json/parts.hpp"

namespace aisle::wire {
namespace {

constexpr std::array kStates{"starting", "waiting", "ready", "degraded", "stopping"};

std::string name_of(aisle::ServiceState state) { return enumerator_name(kStates, state); }

}  // namespace

Json to_json(const aisle::ServiceHealth& sample) {
  Json counters = Json::object();
  for (const aisle::Counter& counter : sample.counters()) counters[counter.name().to_string()] = counter.value();
  return Json{{"instance_id", sample.instance_id().to_string()},
              {"by", to_json(sample.by())},
              {"service", sample.service().to_string()},
              {"software_version", sample.software_version().to_string()},
              {"idl_version", sample.idl_version()},
              {"host", sample.host().to_string()},
              {"process_id", sample.process_id()},
              {"agv_id", sample.agv_id().to_string()},
              {"map_id", sample.map_id().to_string()},
              {"map_revision", sample.map_revision()},
              {"map_hash", hexadecimal(sample.map_hash())},
              {"state", name_of(sample.state())},
              {"waits_for", sample.waits_for().to_string()},
              {"last_error", sample.last_error().to_string()},
              {"wall_clock_ns", sample.wall_clock_ns()},
              {"cpu_percent", sample.cpu_percent()},
              {"resident_mb", sample.resident_mb()},
              {"counters", std::move(counters)}};
}

}  // namespace aisle::wire
