#include "tools/lab/driving/fusion_tables.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "common/process/output_file.hpp"
#include "tools/lab/driving/curves_svg.hpp"
#include "tools/lab/driving/fused_drive.hpp"
#include "tools/lab/driving/ways_svg.hpp"
#include "tools/lab/page/markdown.hpp"

namespace aisle::lab {
namespace {

constexpr double kNearM = 0.6;

using Rows = std::vector<std::vector<std::string>>;

/// One line of a paper's table. Lengths in metres; "-" where the paper gives none.
struct Case {
  const char* title;
  const char* map;
  const char* paper;  // its global and its local planner
  Surprises surprises;
  const char* dwa;
  const char* astar_dwa;
  const char* improved;
  const char* curves;            // file of the picture, or empty
  bool is_said_smoother{false};  // the paper says so of its curves of v and w
  const char* figure{""};        // the paper's, of these curves,
  const char* said{""};          // and what it says of it
};

constexpr Case kCases[] = {
    {"LI, 20x20, static", "li-complex", "li", {}, "-", "-", "-", ""},
    {"LI IV, one mover, unknown boxes",
     "li-complex",
     "li",
     {1, 2},
     "-",
     "-",
     "38.60 (planned 29.85)",
     "li-11-13",
     false,
     "LI 11-13",
     "before a mover it slows down and changes w and its attitude; before a box it changes w and its attitude"},
    {"WU, figures 10 and 11, one avoidance",
     "wu",
     "wu",
     {0, 1},
     "-",
     "-",
     "-",
     "wu-10-11",
     true,
     "WU 10-11",
     "near the obstacle 0.6-0.7 m/s -> 0.3-0.4 and 0.5-0.6 m/s; w from -0.4 to 0.4 rad/s -> from -0.3 to 0.4 rad/s"},
    {"QU, 21x21 simple, static", "qu-simple", "qu", {}, "-", "-", "21.03", ""},
    {"QU 3, simple, one mover", "qu-simple", "qu", {1, 0}, "-", "-", "21.0337", ""},
    {"QU 3, simple, two movers",
     "qu-simple",
     "qu",
     {2, 0},
     "-",
     "-",
     "21.5279",
     "qu-8",
     false,
     "QU 8",
     "v and w fall while it avoids the movers"},
    {"QU, 21x21 maze, static", "qu-maze", "qu", {}, "-", "-", "25.17", ""},
    {"QU 3, maze, one mover", "qu-maze", "qu", {1, 0}, "-", "-", "26.1942", ""},
    {"QU 3, maze, two movers", "qu-maze", "qu", {2, 0}, "-", "-", "26.6783", ""},
    {"YU 5, static", "yu-1", "yu", {0, 1}, "27.0026", "27.9319", "24.5729", "", true},
    {"YU 6, dynamic",
     "yu-1",
     "yu",
     {1, 1},
     "28.4446",
     "25.4588",
     "24.6606",
     "yu-7",
     true,
     "YU 7",
     "w settles soonest and is steadiest; reaches the goal sooner"},
    {"WANG 2, fused",
     "wang-1",
     "wang",
     {},
     "-",
     "30.15",
     "28.57",
     "wang-6-7",
     true,
     "WANG 6-7",
     "v and w change less; 70.56 s -> 57.67 s"},
    {"WANG 3, map 1", "wang-map-1", "wang", {1, 1}, "-", "-", "29.30", ""},
    {"WANG 3, map 2", "wang-map-2", "wang", {1, 1}, "-", "-", "28.46", ""},
    {"WANG 3, map 3", "wang-map-3", "wang", {1, 2}, "-", "-", "57.14", ""},
};

/// The same case driven by all contestants, past the same movers and boxes.
struct Driven {
  const Case* of;
  DriveFigures dwa;               // straight at the goal
  DriveFigures astar;             // A* + the traditional critics
  DriveFigures astar_own;         // A* + the paper's critics
  DriveFigures improved;          // the paper's path + its critics
  DriveFigures improved_plain{};  // the paper's path + the traditional critics: WU compares its DWA with that one
  /// What the paper compares its fusion with: the path alone differs, but for WU the critics alone.
  const DriveFigures& reference() const { return is_wu() ? improved_plain : astar_own; }
  bool is_wu() const { return std::string(of->paper) == "wu"; }
};

/// YU's and WANG's dynamic windows have the traditional critics with weights of their own.
local_planner::Variant dwa_of(const std::string& paper) {
  return paper == "yu" || paper == "wang" ? paper_critics_alone(paper) : traditional_alone();
}

Driven drive(const Case& of, const std::filesystem::path& maps) {
  const local_planner::Variant own = paper_variant(of.paper);
  const auto driven = [&](const char* global, const local_planner::Variant& local) {
    return drive_fused({of.map, global, local, own.paper, of.surprises}, maps);
  };
  Driven all{&of, driven(of.paper, dwa_of(of.paper)), driven("astar", traditional_with_path()), driven("astar", own),
             driven(of.paper, own)};
  if (all.is_wu()) all.improved_plain = driven(of.paper, traditional_with_path());
  return all;
}

std::string length(const DriveFigures& d) {
  const std::string touched = d.result.contacts_moving_vehicle > 0 ? ", touches" : "";
  return d.arrived() ? digits(d.result.distance_m, 2) + touched : "never arrives" + touched;
}

std::string lengths_table(const std::vector<Driven>& all) {
  Rows rows{{"table", "published: DWA", "A* + DWA", "improved + DWA", "ours: DWA", "A* + traditional critics",
             "A* + paper's critics", "improved + paper's critics", "its plan", "driven over plan", "s",
             "movers and boxes", "nearest mover m"}};
  for (const Driven& d : all) {
    const sim::Result& r = d.improved.result;
    const Encounters& there = d.improved.encounters;
    rows.push_back({d.of->title, d.of->dwa, d.of->astar_dwa, d.of->improved, length(d.dwa), length(d.astar),
                    length(d.astar_own), length(d.improved), digits(r.planned_m, 2),
                    d.improved.arrived() ? digits(r.distance_m / r.planned_m, 3) : "-",
                    digits(d.improved.result.driven_s, 1),
                    std::to_string(there.movers.size()) + " and " + std::to_string(there.boxes.size()),
                    d.improved.movers > 0 ? digits(d.improved.nearest_mover_m(), 2) : "-"});
  }
  return markdown_table(rows);
}

std::string arrow(double from, double to) { return digits(from, 2) + " -> " + digits(to, 2); }

std::string smoothness_table(const std::vector<Driven>& all) {
  Rows rows{{"table", "changes of v, m/s", "changes of w, rad/s", "greatest change of w in 0.1 s", "sign changes of w",
             "time s"}};
  for (const Driven& d : all) {
    if (!d.reference().arrived() || !d.improved.arrived()) continue;
    rows.push_back({d.of->title, arrow(d.reference().changes_of_v(), d.improved.changes_of_v()),
                    arrow(d.reference().changes_of_w(), d.improved.changes_of_w()),
                    arrow(d.reference().greatest_change_of_w(), d.improved.greatest_change_of_w()),
                    std::to_string(d.reference().result.turn_sign_changes) + " -> " +
                        std::to_string(d.improved.result.turn_sign_changes),
                    arrow(d.reference().result.driven_s, d.improved.result.driven_s)});
  }
  return markdown_table(rows);
}

std::string verdict(int holds, int of) {
  return (holds == of  ? "holds, "
          : holds == 0 ? "**does not hold**, "
                       : "**holds in part**, ") +
         std::to_string(holds) + " of " + std::to_string(of);
}

/// Counts the cases that `counts` and of them those that `holds`.
template <class Counts, class Holds>
std::string counted(const std::vector<Driven>& all, Counts counts, Holds holds) {
  int of = 0, good = 0;
  for (const Driven& d : all)
    if (counts(d)) ++of, good += holds(d) ? 1 : 0;
  return verdict(good, of);
}

/// The traditional critics and WU's on the same path with one avoidance, by the critics alone: our profile of the way
/// slows both alike.
std::string wu_terms_row(const std::filesystem::path& maps) {
  const local_planner::Variant wu = paper_variant("wu");
  const DriveFigures with = drive_fused({"wu", "wu", wu, wu.paper, {0, 1}, false}, maps);
  const DriveFigures without = drive_fused({"wu", "wu", traditional_with_path(), wu.paper, {0, 1}, false}, maps);
  const double slow = with.mean_speed_near(kNearM), fast = without.mean_speed_near(kNearM);
  const bool holds = is_slower_near(with, without);
  return digits(fast, 3) + " m/s with the traditional critics (published 0.6-0.7), " + digits(slow, 3) +
         " m/s with WU's (0.3-0.6): " + (holds ? "holds" : "**does not hold**");
}

std::string claims_table(const std::vector<Driven>& all, const std::filesystem::path& maps) {
  const auto is_static = [](const Driven& d) { return !d.of->surprises.any(); };
  const auto met_mover = [](const Driven& d) { return d.improved.met_a_mover(); };
  const auto both = [](const Driven& d) { return are_comparable(d.reference(), d.improved, d.of->surprises); };
  const auto said = [&](const Driven& d) { return both(d) && d.of->is_said_smoother; };
  const auto unsaid = [&](const Driven& d) { return both(d) && !d.of->is_said_smoother; };
  const auto fewer_of_v = [](const Driven& d) { return d.improved.changes_of_v() <= d.reference().changes_of_v(); };
  const auto fewer_of_w = [](const Driven& d) { return d.improved.changes_of_w() <= d.reference().changes_of_w(); };
  return markdown_table({
      {"claim", "here"},
      {"driven length within 3 % of the improved global path, static maps",
       counted(all, is_static,
               [](const Driven& d) {
                 return d.improved.arrived() && d.improved.result.distance_m <= 1.03 * d.improved.result.planned_m;
               })},
      {"shorter with the improved path than with that of A\\*, WU's with its critics than with the traditional ones",
       counted(
           all, both,
           [](const Driven& d) { return d.improved.result.distance_m <= d.reference().result.distance_m + 0.005; })},
      {"fewer changes of v with the improved path, where the paper says so (WU 10-11, YU 7, WANG 6-7)",
       counted(all, said, fewer_of_v)},
      {"fewer changes of w, the same tables", counted(all, said, fewer_of_w)},
      {"fewer changes of v, the tables of which no paper says so", counted(all, unsaid, fewer_of_v)},
      {"fewer changes of w, the same", counted(all, unsaid, fewer_of_w)},
      {"no moving vehicle touches a mover or a box, goal reached (LI IV, QU 3, YU 6, WANG 3), where a mover came "
       "within 1.5 m",
       counted(all, met_mover,
               [](const Driven& d) { return d.improved.arrived() && d.improved.result.contacts_moving_vehicle == 0; })},
      {"WU: slower where something is within 0.6 m than with the traditional critics on the same path, both without "
       "our own slowing near walls and in bends",
       wu_terms_row(maps)},
  });
}

/// What the papers say in words and numbers; their curves themselves are printed as pictures.
std::string curves_table(const std::vector<Driven>& all) {
  Rows rows{
      {"curves", "the paper says, traditional -> improved", "ours: its reference", "ours: improved + paper's critics"}};
  for (const Driven& d : all)
    if (!std::string(d.of->curves).empty())
      rows.push_back({d.of->figure, d.of->said, curve_figures(d.reference(), d.of->surprises),
                      curve_figures(d.improved, d.of->surprises)});
  return markdown_table(rows);
}

std::string reference_name(const Driven& d) {
  return d.is_wu() ? "improved A* + traditional critics" : std::string("A* + ") + d.of->paper;
}

std::string improved_name(const Driven& d) { return std::string("improved A* + ") + d.of->paper; }

bool has_curves(const Case& of) { return !std::string(of.curves).empty(); }

std::string curve_file(const Case& of) { return std::string(of.curves) + ".svg"; }

std::string curves(const std::vector<Driven>& all, const std::filesystem::path& pictures,
                   const std::string& from_page) {
  std::string text;
  for (const Driven& d : all) {
    if (!has_curves(*d.of)) continue;
    const std::string file = curve_file(*d.of);
    process::write_output_file(pictures / file,
                               curves_svg(std::string(d.of->title) + " (compare " + d.of->figure + ")",
                                          {{reference_name(d), &d.reference()}, {improved_name(d), &d.improved}}));
    text += std::string("![") + d.of->title + "](" + from_page + "/" + file + ")\n\n";
  }
  return text;
}

DrivenWay way_of(const std::string& name, const DriveFigures& figures) {
  DrivenWay way{name + (figures.arrived() ? "" : ", never arrives"), {}};
  for (const DrivePoint& point : figures.points) way.in_map.push_back(point.base_in_map.position());
  return way;
}

/// One picture a map: of the case that puts most into the way.
std::string ways(const std::vector<Driven>& all, const std::filesystem::path& maps,
                 const std::filesystem::path& pictures, const std::string& from_page) {
  const auto things = [](const Driven& d) { return d.of->surprises.movers + d.of->surprises.hidden_boxes; };
  std::string text;
  for (const Driven& d : all) {
    const bool another_has_more = std::any_of(all.begin(), all.end(), [&](const Driven& other) {
      return std::string(other.of->map) == d.of->map && things(other) > things(d);
    });
    if (another_has_more) continue;
    const std::string map = d.of->map, file = "ways-" + map + ".svg";
    process::write_output_file(
        pictures / file,
        ways_svg(d.of->title, read_drawn_map(maps / (map + ".txt"), 1.0), d.improved.encounters,
                 {way_of(improved_name(d), d.improved), way_of(std::string("A* + ") + d.of->paper, d.astar_own),
                  way_of("A* + traditional critics", d.astar), way_of("DWA alone", d.dwa)}));
    text += std::string("![") + d.of->title + ", driven ways](" + from_page + "/" + file + ")\n\n";
  }
  return text;
}

}  // namespace

std::vector<std::string> curve_files() {
  std::vector<std::string> files;
  for (const Case& of : kCases)
    if (has_curves(of)) files.push_back(curve_file(of));
  return files;
}

bool are_comparable(const DriveFigures& a, const DriveFigures& b, const Surprises& asked) {
  return a.arrived() && b.arrived() && a.met(asked) && b.met(asked);
}

bool is_slower_near(const DriveFigures& drive, const DriveFigures& reference) {
  const double slow_mps = drive.mean_speed_near(kNearM), fast_mps = reference.mean_speed_near(kNearM);
  const bool were_near = slow_mps > 0.0 && fast_mps > 0.0;
  return drive.arrived() && reference.arrived() && were_near && slow_mps < fast_mps;
}

std::string curve_figures(const DriveFigures& d, const Surprises& asked) {
  double low = 0.0, high = 0.0;
  for (const DrivePoint& p : d.points) low = std::min(low, p.angular_radps), high = std::max(high, p.angular_radps);
  const double near_mps = d.mean_speed_near(kNearM);
  return (near_mps > 0.0 ? digits(near_mps, 2) + " m/s near" : std::string("never near")) + ", w from " +
         digits(low, 2) + " to " + digits(high, 2) + ", " + digits(d.changes_of_w(), 1) + " rad/s of changes, " +
         digits(d.result.driven_s, 1) + " s" + (asked.movers > 0 && !d.met_a_mover() ? ", met no mover" : "");
}

FusionTables fusion_tables(const std::filesystem::path& maps, const std::filesystem::path& pictures,
                           const std::string& pictures_from_page, const Progress& progress) {
  std::vector<Driven> all;
  for (const Case& of : kCases) {
    progress(std::string("fusion: ") + of.title);
    all.push_back(drive(of, maps));
  }
  return {lengths_table(all),
          claims_table(all, maps),
          smoothness_table(all),
          curves_table(all),
          curves(all, pictures, pictures_from_page),
          ways(all, maps, pictures, pictures_from_page)};
}

}  // namespace aisle::lab
