#include "tools/lab/driving/local_experiment.hpp"

#include "tools/lab/driving/fusion_tables.hpp"
#include "tools/lab/driving/printed_table.hpp"
#include "tools/lab/driving/suite_tables.hpp"
#include "tools/lab/driving/window_cases.hpp"
#include "tools/lab/page/templates.hpp"
#include "tools/sim/suite.hpp"

namespace aisle::lab {

FilledPage local_section(const LocalExperiment& orders, const Progress& progress) {
  Texts texts;
  texts["commit"] = orders.commit;
  texts["seeds"] = std::to_string(orders.seeds);
  texts["scenarios"] = std::to_string(orders.seeds * static_cast<int>(sim::suite_families().size()));
  texts["suite"] = orders.seeds > 0 ? suite_tables(orders.seeds, progress) : "";

  const FusionTables fusion = fusion_tables(orders.maps, orders.pictures, orders.pictures_from_page, progress);
  texts["lengths"] = fusion.lengths;
  texts["claims"] = fusion.claims;
  texts["smoothness"] = fusion.smoothness;
  texts["curves"] = fusion.curves;
  texts["curve_pictures"] = fusion.pictures;
  texts["way_pictures"] = fusion.ways;
  texts["printed"] = printed_table(orders.maps, progress);

  const WindowTable window = window_table(orders.pictures, orders.pictures_from_page, progress);
  texts["windows"] = window.rows;
  texts["window_pictures"] = window.pictures;
  return fill(kLocalPlanningTemplate, texts);
}

}  // namespace aisle::lab
