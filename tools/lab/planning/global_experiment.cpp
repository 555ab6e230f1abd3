#include "tools/lab/planning/global_experiment.hpp"

#include "tools/lab/planning/markdown.hpp"
#include "tools/lab/planning/paper_tables.hpp"
#include "tools/lab/planning/random_tables.hpp"
#include "tools/lab/planning/real_map_tables.hpp"

namespace aisle::lab {

std::string global_section(const GlobalExperiment& orders, const Progress& progress) {
  std::string text =
      "## Global planning\n\n"
      "Written by `aisle experiment global`; figures do not depend on the machine, times stand in the benchmarks. "
      "Every path is judged by a "
      "checker that knows no search; *faults* counts those it refuses.\n\n"
      "### The papers' tables\n\n"
      "The papers print pictures of their maps, not data. These maps have the same size, start and goal and are of the "
      "same kind "
      "(`deploy/experiments/*.txt`), so directions and orders of size can agree, figures cannot. Blocks were thrown by "
      "seed until traditional A\\* had "
      "the published length within 5 %; where the paper gives none, the first map with a path was taken. For QU these "
      "were the fifth and the second such map: "
      "on the others its path, which cuts no corner, was 1 to 6 % longer than the baseline's, which does; *Which way "
      "the papers' gains go* below says how often that is so. *A\\* as drawn* is the papers' baseline, which "
      "steps through obstacles' corners (LI's moves in four directions only); no vehicle can drive that, so the last "
      "column starts from an A\\* "
      "that cuts no corner.\n\n";
  text += paper_tables(orders.maps, orders.pictures, orders.pictures_from_page, progress);
  text +=
      "### Which way the papers' gains go on random block maps\n\n"
      "One map says little: the maps above were chosen. 200 maps of 20x20 with 8 to 19 blocks, seeds 1 to 200, none "
      "left out where there is a way: the "
      "share of maps on which each paper's planner is strictly better, and its mean length over the baseline's.\n\n";
  text += block_direction_table(progress);
  text +=
      "What holds in general, and what does not: nodes go down on nearly every map, turns on nine maps in ten. LI's "
      "path is shorter and has fewer "
      "turns than an A\\* in four directions, as LI draws it; than one in eight directions it is never shorter, and "
      "seldom straighter. WU's is "
      "shorter on most maps. QU's, YU's and WANG's are shorter than the A\\* as drawn on about half of the maps, for "
      "that one passes through "
      "corners; than an A\\* that a vehicle can drive, on nine maps in ten. LI and WANG expand fewer cells nearly "
      "everywhere. YU, whose tables "
      "say fewer, does so on one map in five; WU and QU, who do not claim it, expand more.\n\n";
  text +=
      "### Expanded cells on random block maps\n\n"
      "200 maps of 20x20 with 8 to 19 blocks, seeds 1 to 200, corner to corner: how many cells fewer than traditional "
      "A\\* (Chebyshev, as WANG "
      "draws it). WANG reports 57.9 % for its own and 56 % for the modified A\\* on one map; negative figures are more "
      "cells. QU's repaired weight never exceeds "
      "1, so it must expand more; it claims shorter and straighter paths, not fewer cells. `jps` counts jump points, "
      "`ant-colony` steps of ants.\n\n";
  text += block_map_table(progress);
  text +=
      "### Random maps\n\n"
      "Edges of 20 to 200 cells, corner to corner, single cells occupied by chance; lengths over the optimum of an "
      "A\\* that cuts no corner, and "
      "the share of maps on which a planner is strictly better than that A\\*. Ants on maps up to 60 cells only.\n\n"
      "What holds on these maps, and what does not: the passes take away turns and nodes on nearly every map (WU, QU, "
      "YU, WANG), LI's do so seldom, "
      "since most points lie beside obstacles. WU's, QU's and YU's paths are shorter than the optimum from cell to "
      "cell on all maps; WANG's on most only "
      "where there are few obstacles, LI's never. LI and WANG expand fewer cells on nearly all maps, WU and QU more "
      "than an A\\* with the octile distance, YU more where few cells are occupied and fewer where many are.\n\n";
  for (const int percent : {10, 20, 30}) {
    text +=
        "#### " + std::to_string(percent) + " % occupied\n\n" + random_map_table(percent, orders.random_maps, progress);
  }
  text += "### Real maps\n\n";
  if (orders.data.empty()) return text + "Left out: no reference data when this page was written.\n\n";
  return text + std::to_string(orders.queries) +
         " queries a map, evenly spread over `queries/<map>.q` of the reference data.\n\n" +
         real_map_tables(orders.data, orders.queries, progress);
}

}  // namespace aisle::lab
