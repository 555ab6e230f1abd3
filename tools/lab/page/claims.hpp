#pragma once

#include <optional>
#include <string>

#include "tools/lab/page/page_template.hpp"

namespace aisle::lab {

/// Do the tables bear the conditions out? None when they do, else the condition that does not hold,
/// with the values that stand there.
///
/// `conditions` are joined by " and ", each "SIDE OP SIDE" with one of < <= > >= == or "SIDE is WORD".
/// A side is a number or cells of a table, NAME[KEY | KEY | COLUMN]: all rows of the text NAME's tables
/// whose first cells are the KEYs, in the column of that heading. A KEY is a cell's text, several as
/// a/b/c, or * for any.
///
/// The condition must hold for every row; a side with several rows stands left of one value. Of a cell
/// "8.30 -> 7.27", `before NAME[..]` takes the left figure and `after NAME[..]` the right; otherwise
/// the first number of the cell counts ("98 %", "4 of 4"). A row that is not there (a drive that never
/// arrived) bears nothing out. @throws std::invalid_argument when a condition cannot be read, or no
/// table has that name and column
std::optional<std::string> refutation(const std::string& conditions, const Texts& texts);

}  // namespace aisle::lab
