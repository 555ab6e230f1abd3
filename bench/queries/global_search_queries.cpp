// Every planner variant and its peers over query files: rounds are interleaved, so that a slow minute of the machine
// hits all.

#include <malloc.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "bench/queries/contestants.hpp"
#include "bench/queries/rows.hpp"
#include "services/global-planner/core/path_checker.hpp"

namespace {

using namespace aisle;
using namespace aisle::bench;

namespace fs = std::filesystem;

/// Of this thread, so that a busy machine disturbs little.
double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Allocated now, in the heap and in mapped blocks.
double heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

/// The value below which `part` of them lie.
double quantile(const std::vector<double>& sorted, double part) {
  return sorted.empty()
             ? 0.0
             : sorted[std::min(sorted.size() - 1, static_cast<std::size_t>(part * static_cast<double>(sorted.size())))];
}

/// No path, or one that the independent checker does not let pass.
bool is_refused(const Site& site, const lab::Query& query, const Reply& reply) {
  if (!reply.is_found) return true;
  const global_planner::Problem problem{site.clearance, query.start_in_map, query.goal_in_map};
  return reply.waypoints_in_map != nullptr && !global_planner::is_drivable(problem, *reply.waypoints_in_map);
}

/// `checks`: whether paths go through the checker, which is not timed. Gives up after `limit_s`.
Row measure(const Site& site, const Contestant& contestant, int round, bool checks, double limit_s) {
  Row row;
  row.map = site.name;
  row.planner = contestant.name;
  row.round = round;
  row.queries = site.queries.size();

  std::vector<double> times_us;
  double spent_s = 0.0;

  for (const lab::Query& query : site.queries) {
    if (spent_s > limit_s) break;

    const double begun_s = cpu_s();
    const Reply reply = contestant.answer(query);
    const double took_us = 1e6 * (cpu_s() - begun_s);

    spent_s += 1e-6 * took_us;
    times_us.push_back(took_us);
    row.solved += reply.is_found ? 1U : 0U;
    row.expanded_mean += static_cast<double>(reply.expanded);
    if (contestant.is_ours && checks && is_refused(site, query, reply)) ++row.undrivable;

    if (!reply.is_found || query.optimum_m <= 0.0) continue;

    const double length_ratio = reply.length_m / query.optimum_m;
    row.length_ratio_mean += length_ratio;
    row.length_ratio_max = std::max(row.length_ratio_max, length_ratio);
  }

  // Means and quantiles over what was asked.
  row.asked = times_us.size();
  for (const double t : times_us) row.mean_us += t / static_cast<double>(row.asked);
  row.expanded_mean /= static_cast<double>(std::max<std::size_t>(1, row.asked));
  row.length_ratio_mean /= static_cast<double>(std::max<std::size_t>(1, row.solved));
  std::sort(times_us.begin(), times_us.end());
  row.p50_us = quantile(times_us, 0.50);
  row.p99_us = quantile(times_us, 0.99);

  return row;
}

/// A first query that is not timed, and what stays allocated after it, in bytes a cell.
double warm_up(const Site& site, const Contestant& contestant) {
  if (site.queries.empty()) return 0.0;

  const double before = heap_bytes();
  contestant.answer(site.queries.front());

  return contestant.is_ours ? std::max(0.0, heap_bytes() - before) / static_cast<double>(site.grid.geometry().cells())
                            : 0.0;
}

/// All contestants but those of these names.
std::vector<Contestant> players_of(const Site& site, const std::vector<std::string>& without) {
  std::vector<Contestant> all = contestants(site);

  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const Contestant& c) {
                             return std::find(without.begin(), without.end(), c.name) != without.end();
                           }),
            all.end());

  return all;
}

/// A planner that did not answer everything in an earlier round is not asked again.
bool is_too_slow(const std::vector<Row>& rows, const std::string& map, const std::string& planner) {
  return std::any_of(rows.begin(), rows.end(), [&](const Row& row) {
    return row.map == map && row.planner == planner && row.asked < row.queries;
  });
}

/// The header of the CSV file.
std::vector<std::string> about(const std::string& machine) {
  return {"machine: " + machine + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads",
          std::string("compiler: GCC ") + __VERSION__ + ", build type " + AISLE_BENCH_BUILD_TYPE,
          std::string("version: ") + AISLE_BENCH_VERSION};
}

std::string machine() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.size(), line.find(':') + 2));
  }

  return "unknown";
}

}  // namespace

int main(int argc, char** argv) {
  std::string data = AISLE_BENCH_DATA;
  std::string out = "out/bench";
  std::string only_map;
  std::vector<std::string> without{"ant-colony"};
  int rounds = 3;
  std::size_t limit = 200;
  double limit_s = 8.0;
  CLI::App app("Times every planner over query files, with a textbook A*, Boost.Graph and OMPL in the same run");

  app.add_option("--data", data, "folder with movingai, ros and queries")->capture_default_str();
  app.add_option("--out", out, "folder for global_search_queries.csv and .txt")->capture_default_str();
  app.add_option("--map", only_map, "only maps with this in their name");
  app.add_option("--without", without, "planners to leave out")->capture_default_str();
  app.add_option("--rounds", rounds, "interleaved")->check(CLI::Range(1, 100))->capture_default_str();
  app.add_option("--limit", limit, "queries a map")->check(CLI::Range(1, 100000))->capture_default_str();
  app.add_option("--seconds", limit_s, "that one planner may take for one map in one round")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const std::vector<Site> sites = read_sites(data, only_map, limit);
  std::vector<std::vector<Contestant>> players;
  std::map<std::pair<std::string, std::string>, double> bytes_a_cell;

  for (const Site& site : sites) {
    players.push_back(players_of(site, without));
    for (const Contestant& player : players.back()) bytes_a_cell[{site.name, player.name}] = warm_up(site, player);
  }

  // Round by round, so that a slow spell of the machine hits all alike.
  std::vector<Row> rows;
  for (int round = 1; round <= rounds; ++round) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      for (const Contestant& player : players[i]) {
        if (is_too_slow(rows, sites[i].name, player.name)) continue;
        rows.push_back(measure(sites[i], player, round, round == 1, limit_s));
        rows.back().bytes_a_cell = bytes_a_cell[{sites[i].name, player.name}];
      }
    }
  }

  std::vector<Bound> bounds;
  for (const Site& site : sites) {
    if (site.is_from_ros && site.any_angle_bound > 0.0) bounds.push_back({site.name, site.any_angle_bound});
  }

  fs::create_directories(out);

  std::ofstream csv(fs::path(out) / "global_search_queries.csv");
  write_csv(csv, about(machine()), rows);

  std::ofstream table(fs::path(out) / "global_search_queries.txt");
  print_table(table, rows);
  print_goals(table, rows, bounds);
  print_table(std::cout, rows);
  print_goals(std::cout, rows, bounds);

  return csv && table ? 0 : 3;
}
