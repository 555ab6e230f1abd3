#pragma once

#include "services/global-planner/core/traffic/joint_plan.hpp"
#include "services/global-planner/core/traffic/meetings.hpp"
#include "services/global-planner/core/traffic/space_time_search.hpp"
#include "services/global-planner/core/traffic/timetable.hpp"
#include "services/global-planner/core/traffic/way_finder.hpp"

namespace aisle::global_planner::traffic {

struct JointPlan::Parts {
  Parts(Roadmap& roadmap_in, const Settings& settings_in)
      : roadmap(roadmap_in),
        settings(settings_in),
        meetings(roadmap_in, settings_in.gap_m),
        timetable(roadmap_in, meetings, settings_in.merge_s, settings_in.soft_rest_s),
        search(roadmap_in, meetings, timetable.reservations(),
               {settings_in.most_expanded, settings_in.merge_s, settings_in.heuristic_weight}),
        ways(roadmap_in, timetable, search, settings_in) {
    search.set_corridor_rests(timetable.corridor_rests());
  }

  Roadmap& roadmap;
  Settings settings;
  Meetings meetings;
  Timetable timetable;
  SpaceTimeSearch search;
  WayFinder ways;
  Patience patience;
};

}  // namespace aisle::global_planner::traffic
