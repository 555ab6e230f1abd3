#pragma once

namespace aisle::lab {

// The sections of docs/experiments.md, from templates/*.md; see page_template.hpp.
extern const char* const kPapersTemplate;
extern const char* const kGlobalPlanningTemplate;
extern const char* const kLocalPlanningTemplate;
extern const char* const kObstacleTrackingTemplate;

}  // namespace aisle::lab
