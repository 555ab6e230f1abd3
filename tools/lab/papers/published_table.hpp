#pragma once
#include <optional>
#include <string>
#include <vector>

#include "services/local-planner/core/critic.hpp"
#include "tools/lab/papers/published.hpp"

// How the files in published/ write a table down: as printed, a row a line.
namespace aisle::lab {

struct PlanColumn {
  const char* name;  // "path length, m"
  PlanFigure figure;
};

struct PlanLine {
  const char* name;     // as printed
  const char* planner;  // of plan_contestants.hpp; null: cannot be made again
  std::vector<double> published;
  const char* why{""};  // planner is null
};

/// A table of planners on one map. The first line is the reference; it is compared with the last one, the paper's own.
struct PlanTable {
  const char* name;
  const char* scene;  // before each row's name; may be empty
  const char* map;
  std::vector<PlanColumn> columns;
  std::vector<PlanLine> lines;
  std::vector<std::string> notes{};  // of each column, may be shorter
};

void append(std::vector<PublishedRow>& rows, const PlanTable& table);

struct DriveColumn {
  const char* name;
  DriveFigure figure;
};

struct DriveLine {
  const char* name;
  const char* contestant;  // of drive_contestants.hpp; null: cannot be made again
  std::vector<double> published;
  const char* why{""};
};

/// The same of drives.
struct DriveTable {
  const char* name;
  const char* scene;
  std::vector<DriveColumn> columns;
  std::vector<DriveLine> lines;
  std::vector<std::string> notes{};
};

void append(std::vector<PublishedRow>& rows, const DriveTable& table);

/// A table of parameters. `ours` is read from the code in use; none where the code has no such parameter.
struct Setting {
  const char* name;
  double published;
  std::optional<double> ours;
  const char* note{""};
};
void append_settings(std::vector<PublishedRow>& rows, const char* table, const std::vector<Setting>& settings);

/// What the variant of the local planner of this name uses: a critic's weight, 0 without that critic; its vehicle.
double weight_of(const char* planner, const local_planner::Critic& critic);
local_planner::PaperLimits limits_of(const char* planner);

/// One row that stands alone.
void append_claim(std::vector<PublishedRow>& rows, const char* table, const char* row, const char* published,
                  ClaimedDirection claim, Evidence evidence, const char* note = "");

/// A number as the papers print it: without zeros at its end.
std::string as_printed(double number);

// The papers, one file each in published/.
void append_li(std::vector<PublishedRow>& rows);
void append_wu(std::vector<PublishedRow>& rows);
void append_qu(std::vector<PublishedRow>& rows);
void append_yu(std::vector<PublishedRow>& rows);
void append_wang(std::vector<PublishedRow>& rows);

}  // namespace aisle::lab
