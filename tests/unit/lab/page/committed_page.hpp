#pragma once
#include <string>

#include "tools/lab/page/page_template.hpp"

// docs/experiments.md taken apart, to be compared with what its templates and its programs make.
namespace aisle::lab {

/// The committed page's text between the lines `<!-- name: begin -->` and `<!-- name: end -->`.
/// @throws std::runtime_error when there is no such section
std::string committed_section(const std::string& name);

/// What stands in the section where the template has its placeholders.
Texts texts_of(const std::string& page_template, const std::string& section);

}  // namespace aisle::lab
