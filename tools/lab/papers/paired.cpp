#include "tools/lab/papers/paired.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace aisle::lab {
namespace {

constexpr double kNormal975 = 1.959963984540054;

double mean_of(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_error(const std::vector<double>& values, double mean) {
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const auto n = static_cast<double>(values.size());
  return std::sqrt(squares / (n - 1.0) / n);
}

/// Ranks of the differences' sizes; equal ones share the mean of their ranks.
struct SignedRanks {
  double of_positive{0.0};
  double of_negative{0.0};
  double ties{0.0};  // sum of t^3 - t over groups of t equal sizes
  double count{0.0};
};

SignedRanks signed_ranks(std::vector<double> differences) {
  differences.erase(std::remove(differences.begin(), differences.end(), 0.0), differences.end());
  std::sort(differences.begin(), differences.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  SignedRanks ranks;
  ranks.count = static_cast<double>(differences.size());
  for (std::size_t first = 0, end = 0; first < differences.size(); first = end) {
    end = first + 1;
    while (end < differences.size() && std::abs(differences[end]) == std::abs(differences[first])) ++end;
    const double shared = 0.5 * static_cast<double>(first + 1 + end);
    const auto equal = static_cast<double>(end - first);
    ranks.ties += equal * equal * equal - equal;
    for (std::size_t i = first; i < end; ++i) (differences[i] > 0.0 ? ranks.of_positive : ranks.of_negative) += shared;
  }
  return ranks;
}

/// By the normal approximation with a correction for ties and for continuity.
double two_sided_p(const SignedRanks& ranks) {
  const double n = ranks.count;
  if (n == 0.0) return 1.0;
  const double expected = n * (n + 1.0) / 4.0;
  const double variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ranks.ties / 48.0;
  const double away = std::max(0.0, std::abs(ranks.of_positive - expected) - 0.5);
  return variance > 0.0 ? std::erfc(away / std::sqrt(2.0 * variance)) : 1.0;
}

}  // namespace

double student_t_975(std::size_t degrees_of_freedom) {
  if (degrees_of_freedom <= 1) return 12.706;
  if (degrees_of_freedom == 2) return 4.303;
  const auto v = static_cast<double>(degrees_of_freedom);
  const double x = kNormal975, x2 = x * x;
  const double g1 = x * (x2 + 1.0) / 4.0;
  const double g2 = x * ((5.0 * x2 + 16.0) * x2 + 3.0) / 96.0;
  const double g3 = x * (((3.0 * x2 + 19.0) * x2 + 17.0) * x2 - 15.0) / 384.0;
  const double g4 = x * ((((79.0 * x2 + 776.0) * x2 + 1482.0) * x2 - 1920.0) * x2 - 945.0) / 92160.0;
  return x + g1 / v + g2 / (v * v) + g3 / (v * v * v) + g4 / (v * v * v * v);
}

PairedComparison compare_pairs(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> differences(a.size());
  std::transform(b.begin(), b.end(), a.begin(), differences.begin(),
                 [](double of_b, double of_a) { return of_b - of_a; });

  PairedComparison comparison;
  comparison.n = a.size();
  comparison.mean_a = mean_of(a);
  comparison.mean_b = mean_of(b);
  comparison.mean_difference = mean_of(differences);
  double reach = 0.0;
  if (a.size() > 1) reach = student_t_975(a.size() - 1) * standard_error(differences, comparison.mean_difference);
  comparison.interval95 = {comparison.mean_difference - reach, comparison.mean_difference + reach};

  const SignedRanks ranks = signed_ranks(std::move(differences));
  comparison.wilcoxon_p = two_sided_p(ranks);
  const double all = ranks.of_positive + ranks.of_negative;
  comparison.effect = all > 0.0 ? (ranks.of_positive - ranks.of_negative) / all : 0.0;
  return comparison;
}

}  // namespace aisle::lab
