#pragma once

#include <map>
#include <string>
#include <vector>

namespace aisle::lab {

/// What fills a template: markdown by the placeholder's name. Line ends at its end do not count.
using Texts = std::map<std::string, std::string>;

/// The result of fill().
struct FilledPage {
  std::string text;
  std::vector<std::string> refuted;  // sentences that were left out, each with the condition that does not hold
};

/// Fills a page's template. Its paragraphs are separated by empty lines, and the lines of one are joined, so that a
/// template may be wrapped as one likes; {name} is replaced by that text. Lines that begin with a colon:
///
///   :claim CONDITION and CONDITION   what follows is left out, and told, unless the page's own tables bear it out
///   :when NAME, :unless NAME         what follows is only there when the text of that name is not empty, or is
///   :end                             of the innermost of these
///
/// A CONDITION compares what stands in cells, see claims.hpp.
/// @throws std::invalid_argument when the template is faulty or names a text that is not in `texts`
FilledPage fill(const std::string& page_template, const Texts& texts);

}  // namespace aisle::lab
