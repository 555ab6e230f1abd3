#include "common/wire/traffic.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "common/wire/geometry.hpp"

namespace aisle::wire {
namespace {

// Sizes are those of the IDL.
constexpr std::size_t kMostExtra = 32;
constexpr std::size_t kMostWaitedFor = 16;
constexpr std::size_t kMostWaiting = 128;
constexpr std::size_t kMostSilent = 128;
constexpr std::size_t kMostReason = 256;
constexpr double kLongestWayM = 1e9;
constexpr double kWidestExtraM = 100.0;
constexpr double kLongestWaitS = 1e9;

template <class Samples>
void encode(const std::vector<fleet::SilentVehicle>& vehicles, Samples& samples) {
  for (std::size_t i = 0; i < std::min(vehicles.size(), kMostSilent); ++i) {
    aisle::SilentVehicle sample;
    sample.agv_id(vehicles[i].agv_id);
    sample.place_in_map(wire::encode(vehicles[i].place_in_map));
    samples.push_back(sample);
  }
}

template <class Samples>
std::vector<fleet::SilentVehicle> decode(const Samples& samples, Checks& checks, const char* id_field,
                                         const char* place_field) {
  std::vector<fleet::SilentVehicle> vehicles;
  for (const aisle::SilentVehicle& sample : samples) {
    vehicles.push_back({sample.agv_id().to_string(), wire::decode(sample.place_in_map(), checks, place_field)});
    checks.id(id_field, vehicles.back().agv_id);
  }

  return vehicles;
}

}  // namespace

aisle::Grant encode(const fleet::Grant& grant) {
  aisle::Grant sample;
  sample.agv_id(grant.agv_id);
  sample.number(grant.number);
  sample.plan_id(grant.plan_id);

  sample.limit_m(grant.limit_m);
  sample.limit_step(grant.limit_step);
  sample.gives_back(grant.gives_back);

  for (std::size_t i = 0; i < std::min(grant.extra.size(), kMostExtra); ++i) {
    aisle::ExtraWidth extra;
    extra.step(grant.extra[i].step);
    extra.left_m(grant.extra[i].left_m);
    extra.right_m(grant.extra[i].right_m);
    sample.extra().push_back(extra);
  }

  for (std::size_t i = 0; i < std::min(grant.waits_for.size(), kMostWaitedFor); ++i)
    sample.waits_for().emplace_back().agv_id(grant.waits_for[i]);

  sample.reason(grant.reason.substr(0, kMostReason));

  return sample;
}

/// Steps of the extra widths do not fall.
Decoded<fleet::Grant> decode(const aisle::Grant& sample) {
  Checks checks;
  fleet::Grant grant;

  grant.agv_id = sample.agv_id().to_string();
  grant.number = sample.number();
  grant.plan_id = sample.plan_id();

  grant.limit_m = sample.limit_m();
  grant.limit_step = sample.limit_step();
  grant.gives_back = sample.gives_back();
  grant.reason = sample.reason().to_string();

  checks.id("agv_id", grant.agv_id)
      .holds(grant.number > 0, "number counts from 1")
      .within("limit_m", grant.limit_m, 0.0, kLongestWayM)
      .count("extra", sample.extra().size(), 0, kMostExtra)
      .count("waits_for", sample.waits_for().size(), 0, kMostWaitedFor);

  if (!checks.ok()) return Decoded<fleet::Grant>::refused(checks.reason());

  std::uint64_t before = 0;
  for (const aisle::ExtraWidth& extra : sample.extra()) {
    checks.holds(extra.step() >= before, "extra.step falls")
        .within("extra.left_m", extra.left_m(), 0.0, kWidestExtraM)
        .within("extra.right_m", extra.right_m(), 0.0, kWidestExtraM);
    before = extra.step();
    grant.extra.push_back({extra.step(), extra.left_m(), extra.right_m()});
  }

  for (const aisle::WaitedFor& other : sample.waits_for()) {
    grant.waits_for.push_back(other.agv_id().to_string());
    checks.id("waits_for.agv_id", grant.waits_for.back());
  }

  return checks.decoded(std::move(grant));
}

aisle::SignOff encode(const fleet::SignOff& sign_off) {
  aisle::SignOff sample;
  sample.agv_id(sign_off.agv_id);
  sample.has_place(sign_off.place_in_map.has_value());
  if (sign_off.place_in_map) sample.place_in_map(encode(*sign_off.place_in_map));

  return sample;
}

Decoded<fleet::SignOff> decode(const aisle::SignOff& sample) {
  Checks checks;
  fleet::SignOff sign_off{sample.agv_id().to_string(), std::nullopt};
  checks.id("agv_id", sign_off.agv_id);
  if (sample.has_place()) sign_off.place_in_map = decode(sample.place_in_map(), checks, "place_in_map");

  return checks.decoded(std::move(sign_off));
}

aisle::TrafficStatus encode(const fleet::TrafficStatus& status) {
  aisle::TrafficStatus sample;
  sample.source_id(status.source_id);
  sample.beat(status.beat);
  sample.register_version(status.register_version);
  sample.vehicles(status.vehicles);
  sample.with_goal(status.with_goal);

  for (std::size_t i = 0; i < std::min(status.waiting.size(), kMostWaiting); ++i) {
    aisle::WaitingVehicle waiting;
    waiting.agv_id(status.waiting[i].agv_id);
    waiting.waits_for(status.waiting[i].waits_for);
    waiting.reason(status.waiting[i].reason.substr(0, kMostReason));
    waiting.since_s(status.waiting[i].since_s);
    sample.waiting().push_back(waiting);
  }

  encode(status.silent, sample.silent());
  encode(status.signed_off, sample.signed_off());

  sample.slice_ms_p99(status.slice_ms_p99);
  sample.refused(status.refused);
  sample.circles(status.circles);
  sample.share_of_places(status.share_of_places);

  return sample;
}

Decoded<fleet::TrafficStatus> decode(const aisle::TrafficStatus& sample) {
  Checks checks;
  fleet::TrafficStatus status;

  status.source_id = sample.source_id().to_string();
  status.beat = sample.beat();
  status.register_version = sample.register_version();
  status.vehicles = sample.vehicles();
  status.with_goal = sample.with_goal();

  status.slice_ms_p99 = sample.slice_ms_p99();
  status.refused = sample.refused();
  status.circles = sample.circles();
  status.share_of_places = sample.share_of_places();

  checks.id("source_id", status.source_id)
      .count("waiting", sample.waiting().size(), 0, kMostWaiting)
      .count("silent", sample.silent().size(), 0, kMostSilent)
      .count("signed_off", sample.signed_off().size(), 0, kMostSilent)
      .finite("slice_ms_p99", status.slice_ms_p99)
      .within("share_of_places", status.share_of_places, 0.0, 1.0);

  if (!checks.ok()) return Decoded<fleet::TrafficStatus>::refused(checks.reason());

  for (const aisle::WaitingVehicle& waiting : sample.waiting()) {
    status.waiting.push_back({waiting.agv_id().to_string(), waiting.waits_for().to_string(),
                              waiting.reason().to_string(), waiting.since_s()});
    checks.id("waiting.agv_id", status.waiting.back().agv_id)
        .optional_id("waiting.waits_for", status.waiting.back().waits_for)
        .within("waiting.since_s", waiting.since_s(), 0.0, kLongestWaitS);
  }

  status.silent = decode(sample.silent(), checks, "silent.agv_id", "silent.place_in_map");
  status.signed_off = decode(sample.signed_off(), checks, "signed_off.agv_id", "signed_off.place_in_map");

  return checks.decoded(std::move(status));
}

}  // namespace aisle::wire
