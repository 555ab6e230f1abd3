#pragma once

#include <vector>

#include "tools/sim/scenarios/building.hpp"

namespace aisle::sim {

// The families of the suite; each vehicle has one goal, and a way to it at all times.

Setup static_clutter(Dice& dice);   // boxes that the map shows
Setup hidden_blocks(Dice& dice);    // and boxes that it does not
Setup person_crossing(Dice& dice);  // people who walk across
Setup person_oncoming(Dice& dice);  // in an aisle
Setup overtaking(Dice& dice);       // somebody slow, the same way
Setup door(Dice& dice);             // one vehicle wide, and somebody comes through
Setup corridor(Dice& dice);         // narrow, with two bends

/// Recorded people, who follow their recording whatever stands in their way. @throws config::BadInput without the
/// reference data
Setup crowd(Dice& dice);
Setup two_vehicles(Dice& dice);   // head-on, at a crossing, at a junction, among boxes
Setup four_vehicles(Dice& dice);  // at a crossing, between racks, among boxes

/// Seconds that each vehicle would need along the shortest way of the map, alone: turn, speed up, drive at full speed,
/// brake. No vehicle can be faster; infinite where there is no way.
std::vector<double> free_run_s(const Setup& setup);

}  // namespace aisle::sim
