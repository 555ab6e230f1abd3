#include "tools/lab/driving/local_experiment.hpp"

#include "tools/lab/driving/fusion_tables.hpp"
#include "tools/lab/driving/suite_tables.hpp"
#include "tools/lab/driving/window_cases.hpp"
#include "tools/lockstep/suite.hpp"

namespace aisle::lab {

std::string local_section(const LocalExperiment& orders, const Progress& progress) {
  std::string text =
      "## Local planning\n\n"
      "Written by `aisle experiment local`, in lock-step with the services' own cores: simulated scans, tracker, both "
      "planners, vehicles with dead time and "
      "lag. Figures do not depend on the machine.\n\n";
  if (orders.seeds > 0) {
    text += "### The suite\n\n" + std::to_string(orders.seeds * static_cast<int>(lockstep::suite_families().size())) +
            " scenarios a planner, " + std::to_string(orders.seeds) +
            " seeds of each family; each vehicle has one goal. A goal is missed when it takes longer than five times "
            "what the vehicle would need alone, at full "
            "speed along the shortest way. A contact counts for the vehicle that moved faster than 0.05 m/s then or 20 "
            "ms before; people of the crowd follow their recording "
            "whatever stands in their way, from the hall's edge on, and half of the others stop for nobody either. "
            "Time and length are means of a scenario. `dwa` drives straight at the goal without a path and is "
            "there for comparison.\n\n" +
            suite_tables(orders.seeds, progress);
  }
  text +=
      "### The papers' fused drives\n\n"
      "One vehicle with the limits of the paper, a disc of 0.35 m, on maps of the same kind as in the section above, "
      "cells of 1 m. The papers drive a point; "
      "their maps are not printed, so directions can agree, figures cannot. *A\\* + DWA* drives along an A\\* that "
      "cuts no corner with the traditional critics, "
      "*improved + DWA* along the paper's own path with the paper's critics, *DWA* straight at the goal. Movers cross "
      "the planned way at 0.5 m/s and stop for "
      "nobody; boxes of 0.5 m stand on it, unknown to the map. Where a map has no room for a mover to cross there is "
      "none: *movers there* says how many, *nearest* "
      "how near one came to the vehicle of the improved drive.\n\n";
  text += fusion_tables(orders.maps, orders.pictures, orders.pictures_from_page, progress);
  text +=
      "### WU's rolling window\n\n"
      "The situations of WU's section 4 with `wu`, in a hall of 20 x 10 m and in an aisle of 2 m: who passes ahead or "
      "behind is no reason to leave the "
      "path; who would be hit is avoided by way of the local sub-targets (green), and the vehicle comes back to the "
      "path; a detour leads around an unknown box; before what closes the aisle it stops and asks for another "
      "plan.\n\n";
  return text + window_section(orders.pictures, orders.pictures_from_page, progress);
}

}  // namespace aisle::lab
