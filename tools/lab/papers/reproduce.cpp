#include "tools/lab/papers/reproduce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"
#include "tools/lab/driving/window_cases.hpp"
#include "tools/lab/papers/commit.hpp"

namespace aisle::lab {
namespace {

using Figures = std::vector<double>;

constexpr double kEqualWithin = 0.01;    // of the reference's mean
constexpr double kHoldsFrom = 0.95;      // of maps or drives
constexpr std::size_t kFewestPairs = 5;  // of drives, for a verdict
constexpr double kDetourFromM = 0.1;     // off the path
constexpr double kBackWithinM = 0.1;

/// "WANG 2" -> "wang-2".
std::string plain(const std::string& name) {
  std::string text;
  for (const char c : name) text += c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string joined(const std::string& a, const std::string& b) { return a.empty() || b.empty() ? a + b : a + "; " + b; }

/// A figure's samples and those of its reference.
struct Pairs {
  Figures reference, ours;
};

Pairs as_percent_less(const Pairs& pairs) {
  Pairs percent;
  for (std::size_t i = 0; i < pairs.ours.size(); ++i) {
    if (pairs.reference[i] == 0.0) continue;
    percent.reference.push_back(0.0);
    percent.ours.push_back(100.0 * (1.0 - pairs.ours[i] / pairs.reference[i]));
  }
  return percent;
}

/// Each pair over its part that stands in the table's first row.
Pairs as_ratio(Pairs pairs, bool ours_is_first) {
  for (std::size_t i = 0; i < pairs.ours.size(); ++i) {
    const double first = ours_is_first ? pairs.ours[i] : pairs.reference[i];
    pairs.ours[i] /= first;
    pairs.reference[i] /= first;
  }
  return pairs;
}

double mean_of(const Figures& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

Verdict verdict_if(bool is_same) { return is_same ? Verdict::kSameDirection : Verdict::kOtherDirection; }

/// Why a claim with a reference is judged so.
std::string reason(ClaimedDirection claim, const PairedComparison& comparison) {
  if (judged(claim, comparison) == Verdict::kSameDirection) return "";
  if (claim == ClaimedDirection::kEqual) return "the means differ by more than 1 %";
  return comparison.interval_excludes_zero() ? "the 95 % interval lies on the other side of zero"
                                             : "no difference is shown: the 95 % interval holds zero";
}

void judge_pairs(const PublishedRow& of, const Pairs& pairs, ReproducedRow& row) {
  const PairedComparison comparison = compare_pairs(pairs.reference, pairs.ours);
  row.ours = comparison.mean_b;
  row.reference = comparison.mean_a;
  row.n = comparison.n;
  row.interval95 = comparison.interval95;
  row.wilcoxon_p = comparison.wilcoxon_p;
  row.effect = comparison.effect;
  row.verdict = judged(of.claim, comparison);
  row.why = joined(row.why, reason(of.claim, comparison));
}

/// Without a reference: the share of maps or drives.
void judge_share(const PublishedRow& of, const Figures& ours, ReproducedRow& row) {
  const double share = mean_of(ours);
  row.ours = share;
  row.n = ours.size();
  row.verdict = judged(of.claim, share);
  row.why = joined(row.why, reason(of.claim, share));
}

void refuse(ReproducedRow& row, const std::string& why) {
  row.verdict = Verdict::kNotComparable;
  row.why = joined(why, row.why);
}

/// What a drive of this scene has to meet, in words.
std::string met_in(const DriveScene& scene) {
  const Surprises& asked = scene.surprises;
  if (asked.movers > 0 && asked.hidden_boxes > 0) return "met a mover and, where the map had a place for one, a box";
  return asked.movers > 0 ? "met a mover" : "met a box";
}

class Reproducing {
 public:
  Reproducing(const Reproduction& orders, const Progress& progress)
      : plans_(orders.maps, progress), drives_(orders.drives, progress), progress_(progress) {}

  ReproducedRow operator()(const PublishedRow& of) {
    ReproducedRow row;
    row.of = &of;
    row.why = of.note;
    std::visit([&](const auto& evidence) { judge(of, evidence, row); }, of.evidence);
    if (of.is_reference && row.ours)
      row.why = joined(row.why, "the row that others are compared with; judged by the paper's own row");
    return row;
  }

 private:
  void judge(const PublishedRow&, const NoEvidence& none, ReproducedRow& row) { refuse(row, none.why); }

  void judge(const PublishedRow& of, const SettingEvidence& setting, ReproducedRow& row) {
    const double printed = std::strtod(of.published.c_str(), nullptr);
    row.ours = setting.ours;
    row.verdict = verdict_if(std::abs(setting.ours - printed) <= 1e-9 + 1e-6 * std::abs(printed));
  }

  void judge(const PublishedRow& of, const PlanEvidence& plan, ReproducedRow& row) {
    Pairs pairs;
    std::istringstream kinds(plan.map);
    for (std::string kind; std::getline(kinds, kind, ',');) {
      const Figures& ours = plans_.of(kind, plan.planner, plan.figure);
      pairs.ours.insert(pairs.ours.end(), ours.begin(), ours.end());
      if (plan.reference == nullptr) continue;
      const Figures& reference = plans_.of(kind, plan.reference, plan.figure);
      pairs.reference.insert(pairs.reference.end(), reference.begin(), reference.end());
    }
    if (plan.reference == nullptr) return judge_share(of, pairs.ours, row);
    if (plan.figure == PlanFigure::kTime && !plan.as_percent) {
      const std::string printed = of.printed_ratio > 0.0 ? "printed " + of.published + "; " : "";
      row.why = joined(row.why, fmt::format("{}ours {:.1f} us against {:.1f} us", printed, mean_of(pairs.ours),
                                            mean_of(pairs.reference)));
      pairs = as_ratio(std::move(pairs), of.is_reference);
    }
    judge_pairs(of, plan.as_percent ? as_percent_less(pairs) : pairs, row);
  }

  void judge(const PublishedRow& of, const DriveEvidence& drive, ReproducedRow& row) {
    const bool is_share = drive.figure == DriveFigure::kArrivesUntouched || drive.figure == DriveFigure::kArrives;
    const bool is_near_mover =
        drive.figure == DriveFigure::kSpeedNearMover || drive.figure == DriveFigure::kTurnNearMover;
    const std::vector<DriveOutcome>& ours = drives_.of(drive.scene, drive.contestant);
    if (is_share) return judge_arrivals(of, ours, drive, row);
    Pairs pairs;
    const std::vector<DriveOutcome>& reference = is_near_mover ? ours : drives_.of(drive.scene, drive.reference);
    for (std::size_t i = 0; i < ours.size(); ++i) {
      if (!ours[i].arrived || !reference[i].arrived) continue;
      if (!ours[i].met_what_is_there || !reference[i].met_what_is_there) continue;  // it shows nothing
      const auto figure = ours[i].figures.find(drive.figure);
      if (figure == ours[i].figures.end()) continue;
      const double other = drive.figure == DriveFigure::kSpeedNearMover  ? ours[i].elsewhere_mps
                           : drive.figure == DriveFigure::kTurnNearMover ? ours[i].elsewhere_radps
                                                                         : figure_of(reference[i], drive.figure);
      if (std::isnan(other)) continue;
      pairs.ours.push_back(figure->second);
      pairs.reference.push_back(other);
    }
    const DriveScene& scene = scene_named(drive.scene);
    const std::string condition = is_near_mover           ? "arrived, " + met_in(scene) + "; drove elsewhere too"
                                  : scene.surprises.any() ? "arrived with both, and both " + met_in(scene)
                                                          : std::string("arrived with both");
    if (pairs.ours.size() < kFewestPairs)
      return refuse(row, fmt::format("only {} of {} drives count: {}", pairs.ours.size(), ours.size(), condition));
    judge_pairs(of, drive.as_percent ? as_percent_less(pairs) : pairs, row);
    row.why = joined(row.why, fmt::format("{} of {} drives count: {}", pairs.ours.size(), ours.size(), condition));
  }

  /// Not a number where this drive has no such figure.
  static double figure_of(const DriveOutcome& outcome, DriveFigure figure) {
    const auto found = outcome.figures.find(figure);
    return found != outcome.figures.end() ? found->second : std::nan("");
  }

  static void judge_arrivals(const PublishedRow& of, const std::vector<DriveOutcome>& drives,
                             const DriveEvidence& drive, ReproducedRow& row) {
    const bool wants_untouched = drive.figure == DriveFigure::kArrivesUntouched;
    Figures good;
    for (const DriveOutcome& outcome : drives) {
      if (wants_untouched && !outcome.met_what_is_there) continue;
      good.push_back(outcome.arrived && (!wants_untouched || !outcome.touched) ? 1.0 : 0.0);
    }
    const std::string counted = fmt::format("{} of {} drives count", good.size(), drives.size()) +
                                (wants_untouched ? ": those that " + met_in(scene_named(drive.scene)) : "");
    if (good.size() < kFewestPairs) return refuse(row, "only " + counted);
    judge_share(of, good, row);
    row.why = joined(row.why, counted);
  }

  void judge(const PublishedRow& of, const WindowEvidence& window, ReproducedRow& row) {
    progress_(std::string("driving ") + window.name);
    for (const WindowCase& window_case : window_cases()) {
      if (window_case.name != window.name) continue;
      const WindowDrive drive = drive_window_case(window_case);
      const bool arrives = drive.result.goals_reached == 1 && drive.result.contacts == 0;
      const bool leaves = drive.farthest_off_m >= kDetourFromM, returns = drive.back_on_it_m <= kBackWithinM;
      const bool wants_detour = window.property == WindowEvidence::Property::kDetoursAndReturns;
      row.ours = drive.farthest_off_m;
      row.n = 1;
      row.verdict = verdict_if(arrives && returns && leaves == wants_detour);
      row.why = joined(row.why, fmt::format("ours: farthest off the path, m; at the end {:.2f} m off{}",
                                            drive.back_on_it_m, arrives ? "" : "; the goal is not reached untouched"));
      return;
    }
    refuse(row, std::string("there is no case ") + window.name + of.note);
  }

  PlanMeasurements plans_;
  DriveMeasurements drives_;
  Progress progress_;
};

nlohmann::ordered_json number_or_text(const std::string& printed) {
  char* end = nullptr;
  const double number = std::strtod(printed.c_str(), &end);
  return !printed.empty() && *end == '\0' ? nlohmann::ordered_json(number) : nlohmann::ordered_json(printed);
}

template <class Value>
nlohmann::ordered_json or_null(const std::optional<Value>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

bool is_a_time(const PublishedRow& row) {
  const auto* plan = std::get_if<PlanEvidence>(&row.evidence);
  return plan != nullptr && plan->figure == PlanFigure::kTime && row.printed_ratio > 0.0;
}

}  // namespace

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kSameDirection:
      return "same direction";
    case Verdict::kOtherDirection:
      return "other direction";
    case Verdict::kNotComparable:
      break;
  }
  return "not comparable";
}

std::vector<std::string> tables_named(const std::string& wanted) {
  const std::string name = plain(wanted);
  std::vector<std::string> found, known{"all"};
  for (const std::string& table : published_tables()) {
    const std::string paper = plain(table.substr(0, table.find(' ')));
    if (name == "all" || name == plain(table) || name == paper) found.push_back(table);
    known.push_back(plain(table));
  }
  if (!found.empty()) return found;
  const std::string nearest = config::nearest_name(name, known);
  throw config::BadInput("there is no table '" + wanted + "'" +
                         (nearest.empty() ? "" : "; did you mean " + nearest + "?") + " See aisle lab list");
}

Verdict judged(ClaimedDirection claim, const PairedComparison& comparison) {
  const bool is_less = comparison.interval95[1]<0.0, is_more = comparison.interval95[0]> 0.0;
  switch (claim) {
    case ClaimedDirection::kLess:
    case ClaimedDirection::kHolds:
      return verdict_if(is_less);
    case ClaimedDirection::kMore:
    case ClaimedDirection::kHoldsNot:
      return verdict_if(is_more);
    case ClaimedDirection::kEqual:
      break;
  }
  return verdict_if(std::abs(comparison.mean_difference) <= kEqualWithin * std::abs(comparison.mean_a));
}

Verdict judged(ClaimedDirection claim, double share) {
  return verdict_if((share >= kHoldsFrom) == (claim == ClaimedDirection::kHolds));
}

std::string reason(ClaimedDirection claim, double share) {
  if (judged(claim, share) == Verdict::kSameDirection) return "";
  return fmt::format("so on {:.1f} %, the bound is {:.0f} %", 100.0 * share, 100.0 * kHoldsFrom);
}

std::string shown_figure(double figure) { return fmt::format("{:.4g}", figure); }

std::vector<ReproducedRow> reproduce(const Reproduction& orders, const Progress& progress) {
  Reproducing reproduced(orders, progress);
  std::vector<ReproducedRow> rows;
  for (const PublishedRow& row : published_rows()) {
    const bool is_wanted = orders.tables.empty() ||
                           std::find(orders.tables.begin(), orders.tables.end(), row.table) != orders.tables.end();
    if (is_wanted && (!orders.is_wanted || orders.is_wanted(row))) rows.push_back(reproduced(row));
  }
  return rows;
}

nlohmann::ordered_json json_of(const std::vector<ReproducedRow>& rows, unsigned seed) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const ReproducedRow& row : rows) {
    all.push_back({{"table", row.of->table},
                   {"row", row.of->row + (is_a_time(*row.of) ? ", ratio to the first row" : "")},
                   {"published", is_a_time(*row.of) ? nlohmann::ordered_json(row.of->printed_ratio)
                                                    : number_or_text(row.of->published)},
                   {"ours", or_null(row.ours)},
                   {"verdict", name(row.verdict)},
                   {"why", row.why.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(row.why)},
                   {"n", row.n},
                   {"interval95", or_null(row.interval95)},
                   {"commit", source_commit()},
                   {"seed", seed},
                   {"reference", or_null(row.reference)},
                   {"is_reference", row.of->is_reference},
                   {"wilcoxon_p", or_null(row.wilcoxon_p)},
                   {"effect", or_null(row.effect)}});
  }
  return all;
}

void VerdictCount::add(Verdict verdict) {
  same_direction += verdict == Verdict::kSameDirection ? 1 : 0;
  other_direction += verdict == Verdict::kOtherDirection ? 1 : 0;
  not_comparable += verdict == Verdict::kNotComparable ? 1 : 0;
}

VerdictCount count(const std::vector<ReproducedRow>& rows) {
  VerdictCount counted;
  for (const ReproducedRow& row : rows) {
    if (!row.of->is_reference) counted.add(row.verdict);
  }
  return counted;
}

}  // namespace aisle::lab
