#include "services/obstacle-tracker/core/association.hpp"

#include <algorithm>
#include <limits>

#include "services/obstacle-tracker/core/disjoint_sets.hpp"

namespace aisle::obstacle_tracker {
namespace {

constexpr double kNever = 1e12;  // cost of a pair that may not be

/// Costs of a component, row by row. It has at least as many columns as rows, so that each row finds one.
struct Matrix {
  int rows{0};
  int columns{0};
  std::vector<double> costs;

  double& at(int row, int column) { return costs[static_cast<std::size_t>(row * columns + column)]; }
};

/// Column of each row from the row of each column.
std::vector<int> columns_of(const std::vector<int>& row_of, int rows) {
  std::vector<int> column_of(static_cast<std::size_t>(rows), -1);
  for (std::size_t c = 0; c < row_of.size(); ++c) {
    if (row_of[c] >= 0) column_of[static_cast<std::size_t>(row_of[c])] = static_cast<int>(c);
  }

  return column_of;
}

/// Gives `column` to the row before it on the path, that row's column to the one before, and so on back to `start`.
void exchange_pairs(int start, int column, const std::vector<int>& before, std::vector<int>& row_of) {
  while (column >= 0) {
    const int previous = before[static_cast<std::size_t>(column)];
    row_of[static_cast<std::size_t>(column)] = previous >= 0 ? row_of[static_cast<std::size_t>(previous)] : start;
    column = previous;
  }
}

/// Column of each row in the cheapest complete assignment. Rows are added one by one. Each time the shortest path of
/// alternating pairs from the new row to a free column is searched (Dijkstra's algorithm over the reduced costs
/// c(i, j) - u(i) - v(j) >= 0, with prices u of rows and v of columns), and the pairs along it are exchanged.
std::vector<int> solve(Matrix& m) {
  const auto n = static_cast<std::size_t>(m.columns);
  std::vector<double> row_price(static_cast<std::size_t>(m.rows), 0.0);
  std::vector<double> column_price(n, 0.0);
  std::vector<int> row_of(n, -1);

  for (int start = 0; start < m.rows; ++start) {
    std::vector<double> shortest(n, std::numeric_limits<double>::infinity());
    std::vector<int> before(n, -1);
    std::vector<char> done(n, 0);

    int row = start;
    int column = -1;

    // Grow the tree of alternating paths by the nearest column, until one is free.
    while (row >= 0) {
      const int from = column;
      double step = std::numeric_limits<double>::infinity();
      for (int j = 0; j < m.columns; ++j) {
        const auto c = static_cast<std::size_t>(j);
        if (done[c]) continue;

        const double length = m.at(row, j) - row_price[static_cast<std::size_t>(row)] - column_price[c];
        if (length < shortest[c]) {
          shortest[c] = length;
          before[c] = from;
        }

        if (shortest[c] < step) {
          step = shortest[c];
          column = j;
        }
      }

      // The new prices keep reduced costs along the tree at 0.
      row_price[static_cast<std::size_t>(start)] += step;

      for (std::size_t c = 0; c < n; ++c) {
        if (!done[c]) {
          shortest[c] -= step;
          continue;
        }

        row_price[static_cast<std::size_t>(row_of[c])] += step;
        column_price[c] -= step;
      }

      done[static_cast<std::size_t>(column)] = 1;
      row = row_of[static_cast<std::size_t>(column)];
    }

    exchange_pairs(start, column, before, row_of);
  }

  return columns_of(row_of, m.rows);
}

/// Index of `value` in `values`, appended when new.
int index_in(std::vector<int>& values, int value) {
  const auto found = std::find(values.begin(), values.end(), value);
  if (found != values.end()) return static_cast<int>(found - values.begin());
  values.push_back(value);

  return static_cast<int>(values.size()) - 1;
}

/// Solves one component and writes its rows' columns into `column_of_row`.
void solve_crowd(const std::vector<Candidate>& crowd, double alone, std::vector<int>& column_of_row) {
  // Number the component's rows and columns from 0.
  std::vector<int> rows;
  std::vector<int> columns;
  for (const Candidate& c : crowd) {
    index_in(rows, c.row);
    index_in(columns, c.column);
  }

  const int n = static_cast<int>(rows.size());

  // A column of its own for each row, in which it stays alone.
  Matrix m{n, static_cast<int>(columns.size()) + n, {}};
  m.costs.assign(static_cast<std::size_t>(m.rows * m.columns), kNever);

  for (const Candidate& c : crowd) m.at(index_in(rows, c.row), index_in(columns, c.column)) = c.cost;
  for (int i = 0; i < n; ++i) m.at(i, static_cast<int>(columns.size()) + i) = alone;

  const std::vector<int> solved = solve(m);
  for (std::size_t i = 0; i < solved.size(); ++i) {
    const auto column = static_cast<std::size_t>(solved[i]);
    if (column < columns.size()) column_of_row[static_cast<std::size_t>(rows[i])] = columns[column];
  }
}

}  // namespace

std::vector<int> assign(int rows, int columns, const std::vector<Candidate>& candidates, double alone) {
  // Components: rows and columns are nodes, candidates are edges.
  const auto nodes = static_cast<std::size_t>(rows + columns);
  DisjointSets sets(nodes);
  for (const Candidate& c : candidates)
    sets.join(static_cast<std::size_t>(c.row), static_cast<std::size_t>(rows + c.column));

  std::vector<std::vector<Candidate>> crowds(nodes);
  for (const Candidate& c : candidates) crowds[sets.root(static_cast<std::size_t>(c.row))].push_back(c);

  // A single pair needs no search.
  std::vector<int> column_of_row(static_cast<std::size_t>(rows), -1);
  for (const std::vector<Candidate>& crowd : crowds) {
    if (crowd.size() == 1) {
      if (crowd.front().cost < alone) column_of_row[static_cast<std::size_t>(crowd.front().row)] = crowd.front().column;
    } else if (!crowd.empty()) {
      solve_crowd(crowd, alone, column_of_row);
    }
  }

  return column_of_row;
}

}  // namespace aisle::obstacle_tracker
