#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace aisle::lab {

/// How a figure stands to that of the row it is compared with, its reference.
enum class ClaimedDirection {
  kLess,
  kMore,
  kEqual,     // within 1 %
  kHolds,     // it is so: less than the reference; without one ours is the share of maps or drives where it is
  kHoldsNot,  // it is not so: more than the reference; without one as above
};

enum class PlanFigure {
  kLength,  // m
  kNodes,
  kTurns,
  kTurned,     // rad, all turns together
  kExpanded,   // cells
  kTime,       // as a ratio to the reference in the same run
  kClearance,  // m, the least along the path
  kIsOptimal,  // 1 when no longer than the grid's optimum, else 0
};

enum class DriveFigure {
  kLength,            // m, driven
  kTime,              // s
  kSharpTurns,        // of the driven way or the plan, both sampled alike
  kChangesOfV,        // m/s, up and down
  kChangesOfW,        // rad/s
  kRangeOfW,          // rad/s, greatest minus least
  kSpeedNear,         // m/s, mean where a wall or box is near
  kSpeedNearTurn,     // m/s, mean near a node where the global path turns sharply
  kSpeedNearMover,    // m/s, mean where a mover is near; its reference is the mean elsewhere
  kTurnNearMover,     // rad/s, mean |w| where a mover is near; its reference is the mean elsewhere
  kDistanceToPath,    // m, mean from the global path
  kArrivesUntouched,  // 1 when the goal is reached and nothing was touched, else 0
  kArrives,           // 1 when the goal is reached
  kTouches,           // 1 when the moving vehicle touched something, else 0
};

/// On maps drawn by seed of a kind (paper_maps.hpp): a planner against another one.
struct PlanEvidence {
  const char* map;
  const char* planner;    // of plan_contestants.hpp
  const char* reference;  // null: none
  PlanFigure figure;
  bool as_percent{false};  // of the reference: how much less
};

/// On drives over such maps (drive_contestants.hpp).
struct DriveEvidence {
  const char* scene;
  const char* contestant;
  const char* reference;  // null: none, or the figure has its own
  DriveFigure figure;
  bool as_percent{false};
};

/// One of WU's situations in a hall, driving/window_cases.hpp.
struct WindowEvidence {
  enum class Property { kNoDetour, kDetoursAndReturns };
  const char* name;
  Property property;
};

/// A parameter: what the code uses.
struct SettingEvidence {
  double ours;
};

/// It cannot be made again here.
struct NoEvidence {
  std::string why;
};

using Evidence = std::variant<NoEvidence, SettingEvidence, PlanEvidence, DriveEvidence, WindowEvidence>;

/// One figure of a row of a paper's table, or one claim of a figure or of the text.
struct PublishedRow {
  std::string table;       // "WANG 2", "WU figure 8", "YU 4" for section 4's text
  std::string row;         // the row's name as printed, and the column
  std::string published;   // as printed: a number, or words
  ClaimedDirection claim;  // against the reference
  Evidence evidence;
  std::string note;           // what the paper's own figures say otherwise, how ours differs
  bool is_reference{false};   // the row that others are compared with; it is judged by the paper's own row
  double printed_ratio{0.0};  // of the printed figure to that of the table's first row; 0: it stands alone
};

/// Every table of the five papers, row by row and column by column, and every claim of a figure, in the papers' order.
const std::vector<PublishedRow>& published_rows();

/// Their tables' names, each once, in that order.
std::vector<std::string> published_tables();

}  // namespace aisle::lab
