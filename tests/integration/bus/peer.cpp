// bus_test_peer DOMAIN PARTITION NAME ROLE [STRENGTH]: a process on loopback that tests start, and kill.
//   plan      writes a plan for agv-1 with STRENGTH every 50 ms, source NAME
//   member    writes vehicle_state of NAME at 10 Hz, and reads everybody's
//   track     writes track 7 every 50 ms
//   map-counter  writes a track every 50 ms, whose id is the number of map ids heard on map_info
//   edit-reader  reads map_edit
//   site      writes map_info, map_tile, vehicle_info, vehicle_state, plan and coverage at 10 Hz
#include <sys/prctl.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <string>

#include "common/bus/dds/dds_bus.hpp"
#include "tests/integration/bus/roles.hpp"

namespace {

using namespace aisle;

std::atomic<bool> stop{false};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return 2;
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // no orphan when the test dies first
  std::signal(SIGTERM, [](int) { stop = true; });
  const std::string name = argv[3];
  const std::string role = argv[4];
  bus::Settings settings;
  settings.domain = std::atoi(argv[1]);
  settings.partition = argv[2];
  settings.interfaces = {"127.0.0.1"};
  settings.participant_name = name;
  bus::DdsBus bus(settings);
  if (!bus_test::play_role(bus, role, name, argc > 5 ? std::atoi(argv[5]) : 0)) return 2;
  bus.run_until(stop);
}
