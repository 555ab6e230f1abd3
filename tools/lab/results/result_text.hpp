#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/lab/results/provenance.hpp"

namespace aisle::lab {

/// A flat JSON object with its keys in order: a row of figures, or the head of a file.
using Row = nlohmann::ordered_json;

/// The head of a file of results: `made_by`, commit, compiler, build type, flags and vectors, and what `particular`
/// adds (seed, parameters).
Row head_of(const std::string& made_by, const Provenance& provenance, const Row& particular);

// CSV (RFC 4180 with comments): a line "# key: value" for each key of the head, then the names of the columns, then a
// line a row. pandas reads it with comment="#".

/// Head and column names.
std::string csv_head(const Row& head, const std::vector<std::string>& columns);

/// One row; a column that it lacks, and null, are empty. Numbers have as many digits as read back the same.
std::string csv_line(const Row& row, const std::vector<std::string>& columns);

// JSON Lines: {"head": {...}}, then an object a row.

std::string jsonl_head(const Row& head);
std::string jsonl_line(const Row& row);

/// The keys of the rows, in the order in which they first come.
std::vector<std::string> columns_of(const std::vector<Row>& rows);

/// All rows as one CSV file's text, or one JSON Lines file's.
std::string csv_text(const Row& head, const std::vector<Row>& rows);
std::string jsonl_text(const Row& head, const std::vector<Row>& rows);

/// A number that JSON has: null where it is not finite.
Row finite(double value);

}  // namespace aisle::lab
