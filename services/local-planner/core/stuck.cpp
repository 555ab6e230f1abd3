#include "services/local-planner/core/stuck.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kLetPassS = 10.0;  // people are let pass for so long; after that they are not passing by, they stay

}  // namespace

void Stuck::begin(time::Stamp now) {
  moved_ = now;
  patience_.begin(now);
}

void Stuck::rest(time::Stamp now) {
  moved_ = now;
  patience_.rest(now);
}

void Stuck::notice_people(bool are_refusing, time::Stamp now) { lets_pass_ = are_refusing && stood_s(now) < kLetPassS; }

bool Stuck::has_tried_enough(Attempt attempt, time::Stamp now) {
  attempt.waits = attempt.waits || lets_pass_;
  return patience_.look(attempt, now) == Grade::kBackOff;
}

}  // namespace aisle::local_planner
