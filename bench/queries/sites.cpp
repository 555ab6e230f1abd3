#include "bench/queries/sites.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "bench/peers/textbook_astar.hpp"
#include "common/grid/formats/map_file.hpp"

namespace aisle::bench {
namespace {

namespace fs = std::filesystem;
constexpr double kReach_m = 2.0;

/// On larger maps fewer queries are asked, so that the slowest peers answer them all.
constexpr std::size_t kCellsOfFullLimit = 320000;

/// A map of the reference data.
struct Known {
  const char* name;
  const char* file;
  bool is_from_ros;
  double any_angle_bound;  // shared/spec/performance.md
};

constexpr Known kMaps[] = {{"warehouse-10-20-10-2-1", "movingai/warehouse-10-20-10-2-1.map", false, 0.9422},
                           {"room-64-64-16", "movingai/room-64-64-16.map", false, 0.9160},
                           {"random-64-64-20", "movingai/random-64-64-20.map", false, 0.8938},
                           {"maze-128-128-10", "movingai/maze-128-128-10.map", false, 0.9362},
                           {"den520d", "movingai/den520d.map", false, 0.9442},
                           {"Berlin_1_256", "movingai/Berlin_1_256.map", false, 0.9385},
                           {"willow-full", "ros/willow-full.yaml", true, 0.9547},
                           {"nav2_depot", "ros/nav2_depot.yaml", true, 0.9514},
                           {"nav2_warehouse", "ros/nav2_warehouse.yaml", true, 0.9516}};

/// With the queries that belong to the map.
Site read_site(const fs::path& data, const Known& known, std::size_t limit) {
  Site site{known.name, grid::read_map_file(data / known.file), {}, {}, known.is_from_ros, known.any_angle_bound};
  site.clearance = grid::ClearanceField(site.grid, kReach_m);

  const std::size_t cells = site.grid.geometry().cells();
  const std::size_t fewer =
      std::max<std::size_t>(std::min<std::size_t>(limit, 10), limit * std::min(cells, kCellsOfFullLimit) / cells);

  site.queries = lab::read_queries(data / "queries" / (std::string(known.name) + ".q"), site.grid.geometry(), fewer);
  return site;
}

/// Starts and goals three cells apart on the same map: what a query costs beside its expansions.
Site near_pairs(const Site& large) {
  Site site{large.name + " (near)", large.grid, large.clearance, {}, true, 0.0};
  const grid::Geometry& g = site.grid.geometry();

  for (const lab::Query& query : large.queries) {
    const grid::Cell start = g.cell_at(query.start_in_map);
    bool is_open = true;

    for (int k = 0; k <= 3; ++k) is_open = is_open && site.grid.is_free({start.x + k, start.y});

    if (is_open)
      site.queries.push_back({query.start_in_map, g.center_in_map({start.x + 3, start.y}), 3.0 * g.resolution_m});
  }

  return site;
}

/// Random pairs; the textbook A* tells the optimum.
Site shipped_warehouse(std::size_t limit) {
  Site site{"shipped warehouse", grid::read_map_file(AISLE_BENCH_MAP), {}, {}, true, 0.0};
  site.clearance = grid::ClearanceField(site.grid, kReach_m);

  const grid::Geometry& g = site.grid.geometry();
  std::mt19937 random(11);
  std::uniform_int_distribution<int> x(0, g.width - 1);
  std::uniform_int_distribution<int> y(0, g.height - 1);

  while (site.queries.size() < limit) {
    const grid::Cell start{x(random), y(random)};
    const grid::Cell goal{x(random), y(random)};
    if (start == goal || !site.grid.is_free(start) || !site.grid.is_free(goal)) continue;

    const PeerAnswer answer = textbook_astar(site.grid, start, goal);
    if (answer.is_found)
      site.queries.push_back({g.center_in_map(start), g.center_in_map(goal), answer.length_cells * g.resolution_m});
  }

  return site;
}

}  // namespace

/// In the order of kMaps.
std::vector<Site> read_sites(const fs::path& data, const std::string& only, std::size_t limit) {
  std::vector<Site> sites;
  if (!fs::exists(data / "queries")) {
    sites.push_back(shipped_warehouse(limit));
    return sites;
  }

  for (const Known& known : kMaps) {
    if (std::string(known.name).find(only) != std::string::npos) sites.push_back(read_site(data, known, limit));
  }

  if (!sites.empty() && sites.back().name == "nav2_warehouse") sites.push_back(near_pairs(sites.back()));
  return sites;
}

}  // namespace aisle::bench
