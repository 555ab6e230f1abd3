#include "tools/lab/driving/suite_tables.hpp"

#include <string>
#include <utility>
#include <vector>

#include "common/config/reader.hpp"
#include "services/local-planner/core/critic.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/sim/suite.hpp"

namespace aisle::lab {
namespace {

using sim::SuiteRow;
using sim::Totals;

const std::vector<std::string> kHeading{"goals",
                                        "contacts of a moving vehicle",
                                        "of others with a standing one",
                                        "least clearance m",
                                        "time s",
                                        "length m",
                                        "sign changes of w",
                                        "jerk m/s^3"};

std::vector<std::string> cells(const std::string& first, const Totals& t) {
  const double runs = t.runs;
  return {first,
          std::to_string(t.goals_reached) + " of " + std::to_string(t.goals_assigned),
          std::to_string(t.contacts_moving_vehicle),
          std::to_string(t.contacts - t.contacts_moving_vehicle),
          digits(t.least_clearance_m, 3),
          digits(t.driven_s / runs, 1),
          digits(t.distance_m / runs, 1),
          digits(t.omega_sign_changes / runs, 1),
          digits(t.jerk_rms, 2)};
}

std::vector<std::string> heading(const std::string& first) {
  std::vector<std::string> row{first};
  row.insert(row.end(), kHeading.begin(), kHeading.end());
  return row;
}

}  // namespace

std::string suite_tables(int seeds, const Progress& progress) {
  std::vector<std::vector<std::string>> planners{heading("planner")};
  std::string families;
  std::string left_out;
  for (const local_planner::Variant& variant : local_planner::all_variants()) {
    Totals all;
    std::vector<std::vector<std::string>> rows{heading("family")};
    for (const std::string& family : sim::suite_families()) {
      progress("suite: " + variant.name + ", " + family);
      try {
        const SuiteRow row = sim::run_family(family, variant.name, 1, seeds);
        rows.push_back(cells(family, row.totals));
        all.add(row.totals);
      } catch (const config::BadInput& missing) {
        left_out = "Left out for lack of reference data: " + family + ".\n\n";
      }
    }
    planners.push_back(cells(variant.name, all));
    families += "#### Suite, " + variant.name + "\n\n" + markdown_table(rows);
  }
  return markdown_table(planners) + left_out + families;
}

}  // namespace aisle::lab
