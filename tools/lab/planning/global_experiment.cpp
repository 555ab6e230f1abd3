#include "tools/lab/planning/global_experiment.hpp"

#include "tools/lab/page/templates.hpp"
#include "tools/lab/planning/paper_tables.hpp"
#include "tools/lab/planning/random_tables.hpp"
#include "tools/lab/planning/real_map_tables.hpp"

namespace aisle::lab {

/// Fills the template's places one by one.
FilledPage global_section(const GlobalExperiment& orders, const Progress& progress) {
  Texts texts;
  texts["commit"] = orders.commit;
  texts["paper_tables"] = paper_tables(orders.maps, orders.pictures, orders.pictures_from_page, progress);
  texts["block_directions"] = block_direction_table(progress);
  texts["block_expanded"] = block_map_table(progress);

  for (const int percent : {10, 20, 30})
    texts["random_" + std::to_string(percent)] = random_map_table(percent, orders.random_maps, progress);

  texts["queries"] = std::to_string(orders.queries);
  texts["real_maps"] = orders.data.empty() ? "" : real_map_tables(orders.data, orders.queries, progress);

  return fill(kGlobalPlanningTemplate, texts);
}

}  // namespace aisle::lab
