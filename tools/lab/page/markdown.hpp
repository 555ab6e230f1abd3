#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace aisle::lab {

/// A table: the first row is the heading, all but the first column are aligned to the right.
std::string markdown_table(const std::vector<std::vector<std::string>>& rows);

/// "12.34"; "-" for what is not a number.
std::string digits(double value, int after_point);

/// The page with everything between the lines `<!-- name: begin -->` and `<!-- name: end -->` replaced
/// by `text`. A section that is not there yet is put before the first of the sections `next` that is, else at the end.
/// So several experiments share one page.
std::string with_section(const std::string& page, const std::string& name, const std::string& text,
                         const std::vector<std::string>& next = {});

}  // namespace aisle::lab
