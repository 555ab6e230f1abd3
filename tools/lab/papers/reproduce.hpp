#pragma once
#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/lab/page/progress.hpp"
#include "tools/lab/papers/drive_measurements.hpp"
#include "tools/lab/papers/paired.hpp"
#include "tools/lab/papers/plan_measurements.hpp"
#include "tools/lab/papers/published.hpp"

namespace aisle::lab {

enum class Verdict { kSameDirection, kOtherDirection, kNotComparable };
const char* name(Verdict verdict);

/// A published row beside what was made of it here.
struct ReproducedRow {
  const PublishedRow* of{nullptr};
  Verdict verdict{Verdict::kNotComparable};
  std::string why;                                  // what bears the verdict, and what the paper's own figures say
  std::optional<double> ours;                       // mean over maps or drives; none when not comparable
  std::optional<double> reference;                  // of the row that it is compared with
  std::size_t n{0};                                 // maps, drives or cases behind it; 0 for a parameter
  std::optional<std::array<double, 2>> interval95;  // of the mean difference from the reference
  std::optional<double> wilcoxon_p;
  std::optional<double> effect;
};

struct Reproduction {
  std::vector<std::string> tables;  // as in published_tables(); empty: all
  MapDraw maps;
  DriveDraw drives;
  std::function<bool(const PublishedRow&)> is_wanted{};  // of these tables' rows; none: every one
};

/// The tables meant by a name: "all", a paper ("WANG", "wang"), or a table ("WANG 2", "wang-2", "wu-figure-8").
/// @throws config::BadInput with the names there are
std::vector<std::string> tables_named(const std::string& name);

/// Judges a figure with a reference: same direction when the 95 % interval of the mean difference lies on the claimed
/// side of zero; a claimed equality when the means differ by at most 1 %.
Verdict judged(ClaimedDirection claim, const PairedComparison& comparison);

/// Judges a claim without a reference by the share (0 to 1) of maps or drives where it is so: it holds from 95 % on.
Verdict judged(ClaimedDirection claim, double share);

/// Why it is judged so; empty for the same direction.
std::string reason(ClaimedDirection claim, double share);

/// Makes every row of these tables again.
std::vector<ReproducedRow> reproduce(const Reproduction& orders, const Progress& progress);

/// A figure with as many digits as matter: "28.53", "0.4137", "1234".
std::string shown_figure(double figure);

/// One object a row: table, row, published, ours, verdict, why, n, interval95, commit, seed, and further figures.
nlohmann::ordered_json json_of(const std::vector<ReproducedRow>& rows, unsigned seed);

/// How many of each verdict; reference rows do not count, for they repeat the verdict of the paper's own row.
struct VerdictCount {
  int same_direction{0}, other_direction{0}, not_comparable{0};
  int all() const { return same_direction + other_direction + not_comparable; }
  void add(Verdict verdict);
};
VerdictCount count(const std::vector<ReproducedRow>& rows);

}  // namespace aisle::lab
