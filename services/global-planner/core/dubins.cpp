#include "services/global-planner/core/dubins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aisle::global_planner {
namespace {

using geometry::kPi;
using geometry::Pose2;

/// The angle in [0, 2 pi).
double turned(double angle_rad) {
  const double in_circle = std::fmod(angle_rad, 2.0 * kPi);
  return in_circle < 0.0 ? in_circle + 2.0 * kPi : in_circle;
}

/// Lengths of the three pieces in radii, or angles for arcs, with the word's turns (1 left, -1 right, 0 straight).
struct Word {
  std::array<int, 3> turns;
  double t;
  double p;
  double q;
};

/// The words between two headings a, b at a distance d in radii, both headings measured from the line between the poses
/// (Shkel, Lumelsky 2001; t, p, q as there). Not all are solutions everywhere: the caller looks where each ends.
std::array<Word, 6> words(double a, double b, double d) {
  const double sa = std::sin(a);
  const double sb = std::sin(b);
  const double ca = std::cos(a);
  const double cb = std::cos(b);
  const double cab = std::cos(a - b);
  const auto root = [](double square) { return std::sqrt(std::max(square, 0.0)); };
  const auto arc = [](double cosine) { return turned(2.0 * kPi - std::acos(std::clamp(cosine, -1.0, 1.0))); };

  std::array<Word, 6> all{};

  // Arc, straight, arc: both arcs to one side.
  const double lsl = std::atan2(cb - ca, d + sa - sb);
  all[0] = {{1, 0, 1}, turned(lsl - a), root(2.0 + d * d - 2.0 * cab + 2.0 * d * (sa - sb)), turned(b - lsl)};

  const double rsr = std::atan2(ca - cb, d - sa + sb);
  all[1] = {{-1, 0, -1}, turned(a - rsr), root(2.0 + d * d - 2.0 * cab + 2.0 * d * (sb - sa)), turned(rsr - b)};

  // Arc, straight, arc: one to each side.
  const double lsr_p = root(d * d - 2.0 + 2.0 * cab + 2.0 * d * (sa + sb));
  const double lsr = std::atan2(-ca - cb, d + sa + sb) - std::atan2(-2.0, lsr_p);
  all[2] = {{1, 0, -1}, turned(lsr - a), lsr_p, turned(lsr - b)};

  const double rsl_p = root(d * d - 2.0 + 2.0 * cab - 2.0 * d * (sa + sb));
  const double rsl = std::atan2(ca + cb, d - sa - sb) - std::atan2(2.0, rsl_p);
  all[3] = {{-1, 0, 1}, turned(a - rsl), rsl_p, turned(b - rsl)};

  // Three arcs.
  const double rlr_p = arc((6.0 - d * d + 2.0 * cab + 2.0 * d * (sa - sb)) / 8.0);
  const double rlr_t = turned(a - std::atan2(ca - cb, d - sa + sb) + 0.5 * rlr_p);
  all[4] = {{-1, 1, -1}, rlr_t, rlr_p, turned(a - b - rlr_t + rlr_p)};

  const double lrl_p = arc((6.0 - d * d + 2.0 * cab + 2.0 * d * (sb - sa)) / 8.0);
  const double lrl_t = turned(-a - std::atan2(ca - cb, d + sa - sb) + 0.5 * lrl_p);
  all[5] = {{1, -1, 1}, lrl_t, lrl_p, turned(b - a - lrl_t + lrl_p)};

  return all;
}

}  // namespace

Pose2 along_arc(const Pose2& from, double turn, double length_m) {
  // With the curvature k: x' = x + (sin(yaw + k s) - sin yaw) / k, y' = y - (cos(yaw + k s) - cos yaw) / k.
  const double swept = turn * length_m;
  if (std::abs(swept) < 1e-12)
    return {from.x + length_m * std::cos(from.yaw), from.y + length_m * std::sin(from.yaw), from.yaw};

  return {from.x + (std::sin(from.yaw + swept) - std::sin(from.yaw)) / turn,
          from.y - (std::cos(from.yaw + swept) - std::cos(from.yaw)) / turn, geometry::wrap(from.yaw + swept)};
}

Pose2 DubinsPath::pose_at(double along_m) const {
  Pose2 pose = from_in_map;
  for (const Piece& piece : pieces) {
    const double here_m = std::clamp(along_m, 0.0, piece.length_m);
    pose = along_arc(pose, piece.turn, here_m);
    along_m -= here_m;
  }

  return pose;
}

DubinsPath shortest_dubins(const Pose2& from, const Pose2& to, double radius_m) {
  // Headings from the line between the poses, and their distance in radii.
  const double between = geometry::distance(from.position(), to.position()) > 0.0
                             ? geometry::bearing(from.position(), to.position())
                             : 0.0;
  const double d = geometry::distance(from.position(), to.position()) / radius_m;

  DubinsPath best;
  best.length_m = std::numeric_limits<double>::infinity();

  for (const Word& word : words(turned(from.yaw - between), turned(to.yaw - between), d)) {
    DubinsPath path;
    path.from_in_map = from;

    const std::array<double, 3> lengths{word.t, word.p, word.q};
    for (std::size_t i = 0; i < 3; ++i) path.pieces[i] = {word.turns[i] / radius_m, lengths[i] * radius_m};
    path.length_m = (word.t + word.p + word.q) * radius_m;

    // A word counts only if it ends where it should.
    const Pose2 end = path.pose_at(path.length_m);
    const bool arrives = geometry::distance(end.position(), to.position()) < 1e-6 * (radius_m + d * radius_m) + 1e-9 &&
                         std::abs(geometry::wrap(end.yaw - to.yaw)) < 1e-6;
    if (arrives && path.length_m < best.length_m) best = path;
  }

  return best;
}

}  // namespace aisle::global_planner
