#pragma once

// Who computed a sample: `by` of the IDL's types to and from fleet::Origin. A value has no origin of its own: it comes
// beside the value (origin_of) and is written by the writer (stamp).

#include <type_traits>
#include <utility>

#include "common/fleet/origin.hpp"
#include "common/wire/checks.hpp"
#include "idl/geometry.hpp"

namespace aisle::wire {

inline aisle::Origin encode(const fleet::Origin& origin) {
  aisle::Origin sample;
  sample.source_id(origin.source_id);
  sample.boot_id(origin.boot_id);
  sample.epoch(origin.epoch);
  sample.sequence_number(origin.sequence_number);
  sample.stamp_ns(origin.stamp_ns);

  return sample;
}

/// For samples that carry another sample's origin: it must be complete.
inline fleet::Origin decode(const aisle::Origin& sample, Checks& checks, const char* field = "by") {
  fleet::Origin origin{sample.source_id().to_string(), sample.boot_id(), sample.epoch(), sample.sequence_number(),
                       sample.stamp_ns()};
  checks.id(field, origin.source_id);
  checks.holds(origin.sequence_number > 0, "by.sequence_number counts from 1");

  return origin;
}

/// Has the sample's type a field `by`?
template <class Sample, class = void>
struct HasOrigin : std::false_type {};

template <class Sample>
struct HasOrigin<Sample, std::void_t<decltype(std::declval<const Sample&>().by())>> : std::true_type {};

/// The source of a sample, as far as the sample tells. A source id with control characters counts as
/// none; a type without `by` gives an empty origin.
template <class Sample>
fleet::Origin origin_of(const Sample& sample) {
  if constexpr (HasOrigin<Sample>::value) {
    const aisle::Origin& by = sample.by();
    fleet::Origin origin{by.source_id().to_string(), by.boot_id(), by.epoch(), by.sequence_number(), by.stamp_ns()};
    if (Checks::has_control_characters(origin.source_id)) origin.source_id.clear();
    return origin;
  } else {
    return {};
  }
}

/// Sets `by`; does nothing for a type without it.
template <class Sample>
void stamp(Sample& sample, const fleet::Origin& origin) {
  if constexpr (HasOrigin<Sample>::value) sample.by(encode(origin));
}

}  // namespace aisle::wire
