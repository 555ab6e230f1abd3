#pragma once

#include <string>

#include "services/global-planner/core/planner.hpp"

namespace aisle::global_planner {

/// Why there is no plan, finer than its Outcome: each reason asks its reader to do something else.
enum class Refusal {
  kNotFinite,  // a coordinate or the radius is NaN, infinite, or the radius negative
  kStartOutOfMap,
  kGoalOutOfMap,
  kStartInObstacle,  // or in unknown space
  kGoalInObstacle,
  kStartTooTight,  // free, but the vehicle does not fit
  kGoalTooTight,
  kTooWide,   // there is a way for a smaller vehicle
  kTooStiff,  // wide enough, but not for its turning radius and headings
  kNoWay,     // not even for a point
  kOutOfTime,
};

/// A refusal in words.
struct RefusalReport {
  Refusal refusal;
  std::string line;  // says what, where, and which figure would do
};

/// Explains an outcome other than kFound. For a blocked way it looks for the widest one, which can take longer than the
/// search did; that ends when out of time.
RefusalReport explain(const Problem& problem, Outcome outcome, const OutOfTime& out_of_time);

/// As it is said in logs: "start in obstacle".
const char* name(Refusal refusal);

/// The radius in metres of the widest vehicle that gets from start to goal, tight ends not counted; 0 when not even a
/// point does, or when out of time. @pre both in the map
double widest_way_m(const Problem& problem, const OutOfTime& out_of_time);

}  // namespace aisle::global_planner
