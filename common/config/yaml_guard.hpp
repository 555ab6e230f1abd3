#pragma once

#include <string>

namespace aisle::config {

/// Parses the YAML once without building anything, and refuses constructs that could grow without end:
/// anchors, aliases, nesting deeper than 32 levels, more than one document. @throws BadInput
/// "name:line: why"
void refuse_yaml_bombs(const std::string& text, const std::string& name);

}  // namespace aisle::config
