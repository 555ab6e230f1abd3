#pragma once

#include <memory>
#include <string>
#include <vector>

#include "services/global-planner/core/parameters.hpp"
#include "services/global-planner/core/planner.hpp"

namespace aisle::global_planner {

/// One file in core/variants/ a variant: `stem.cpp` defines `Variant stem()`, and the build writes the table from the
/// files.
struct Variant {
  std::string name;        // as in configuration files and on the wire, at most 32 characters
  std::string summary;     // one line
  bool is_optimal{false};  // among 8-connected paths that cut no corner
  std::unique_ptr<Planner> (*build)(Parameters&);
  bool is_never_longer{false};  // than that optimum, even where it is not a path from cell to cell
  bool knows_headings{false};   // plans for the steering and its discs ahead, where the problem has some

  /// As published.
  std::unique_ptr<Planner> make() const;
  /// With parameters that are set otherwise. @throws std::invalid_argument for an unknown name or a value out of range
  std::unique_ptr<Planner> make(Parameters parameters) const;
  /// What may be set, with the defaults.
  std::vector<Parameter> parameters() const;
};

/// Every variant, by name.
const std::vector<Variant>& all_variants();

/// Null when there is none of this name.
const Variant* find_variant(const std::string& name);

}  // namespace aisle::global_planner
