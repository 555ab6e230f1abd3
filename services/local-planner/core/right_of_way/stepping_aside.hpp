#pragma once

#include <string>
#include <vector>

#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/right_of_way/traffic.hpp"
#include "services/local-planner/core/surroundings.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// Peers near here that go first and whose claimed way runs through where this vehicle stands.
std::vector<std::string> asking_for_room(const Advice& advice, const Surroundings& around, const Moment& moment);

/// Peers under way so near that the vehicle may be stuck with them.
std::vector<std::string> stuck_with(const Surroundings& around, const Moment& moment);

/// The nearest place, by the way there, that no claim of the peers `for_whom`, nor of any that goes first, comes near
/// to. Where no peer asks: any place 0.7 m away or farther. Where there is none, or for a vehicle that cannot turn on
/// the spot: empty. The way there, in map, from where the vehicle is.
///
/// How: the lattice search, which expands places by the way to them, accepts the first one that every claim passes by
/// at a distance of both radii and the margin.
/// @param margin_m between the discs of two vehicles whose ways do not conflict
std::vector<geometry::Point2> way_aside(const Moment& moment, const Surroundings& around, const Way& way,
                                        const std::vector<std::string>& for_whom, double margin_m);

}  // namespace aisle::local_planner
