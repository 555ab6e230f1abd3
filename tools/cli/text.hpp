#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace aisle::cli {

/// A name of an enumerator as one word, "no_goal", as the JSON of samples has it.
std::string word_of(std::string name);

/// The text under `key` of a row; "-" where there is none.
std::string word(const nlohmann::ordered_json& row, const char* key);

/// How much of a sample a person wants to see.
enum class Length { kShort, kFull };

/// A sample as indented `field: value` lines; small structures on one line, long lists cut after a few elements with
/// the number of all (unless kFull). Control characters are shown as \xNN, so what comes over the wire cannot steer the
/// terminal.
std::string text_of_sample(const nlohmann::ordered_json& sample, Length length);

/// Columns of equal width, two spaces apart; the first row is the heading.
std::string text_of_table(const std::vector<std::vector<std::string>>& rows);

/// Without control characters; \xNN instead.
std::string printable(const std::string& text);

}  // namespace aisle::cli
