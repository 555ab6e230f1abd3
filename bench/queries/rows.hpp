#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace aisle::bench {

/// One contestant on one map in one round.
struct Row {
  std::string map;
  std::string planner;
  int round{0};
  std::size_t queries{0};
  std::size_t asked{0};  // fewer than `queries` when it took too long
  std::size_t solved{0};
  std::size_t undrivable{0};  // what the path checker refused, or missed; ours only
  double mean_us{0.0}, p50_us{0.0}, p99_us{0.0};
  double expanded_mean{0.0};
  double length_ratio_mean{0.0}, length_ratio_max{0.0};  // to the octile optimum
  double bytes_a_cell{0.0};                              // that it kept after the first query; ours only

  /// Only such rows are compared with others.
  bool is_whole() const { return asked == queries && solved == queries; }
};

/// `about`: lines for the header, each with "# " in front.
void write_csv(std::ostream& out, const std::vector<std::string>& about, const std::vector<Row>& rows);

/// Medians over the rounds: one line a map and planner.
void print_table(std::ostream& out, const std::vector<Row>& rows);

/// The goals of performance.md that these rows can tell of, one line each: figure, limit, met or missed.
/// `bounds`: per ROS map the any-angle bound over the octile optimum.
struct Bound {
  std::string map;
  double any_angle;
};

void print_goals(std::ostream& out, const std::vector<Row>& rows, const std::vector<Bound>& ros_maps);

}  // namespace aisle::bench
