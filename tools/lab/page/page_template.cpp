#include "tools/lab/page/page_template.hpp"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "tools/lab/page/claims.hpp"

namespace aisle::lab {
namespace {

std::string without_line_ends(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

bool begins_with(const std::string& line, const std::string& head) { return line.rfind(head, 0) == 0; }

/// A :claim, :when or :unless that has not ended.
struct Block {
  bool is_shown;                       // it and all around it
  std::optional<std::string> refuted;  // why the claim was left out
};

/// Reads a template line by line and collects paragraphs.
///
/// How: a stack of open blocks says whether lines are shown. Lines of a claim that does not hold are
/// collected apart, to be told.
class Filling {
 public:
  explicit Filling(const Texts& texts) {
    for (const auto& [name, text] : texts) texts_[name] = without_line_ends(text);
    for (const auto& [name, text] : texts_) arguments_.push_back(fmt::arg(name.c_str(), text));
  }

  /// The next line of the template.
  void add(const std::string& line) {
    if (line.empty()) return end_paragraph();
    if (begins_with(line, ":")) return direct(line);
    if (is_shown()) append(paragraph_, line);
    if (!is_shown() && blocks_.back().refuted) append(left_out_, line);
  }

  /// To be called once, after the last line.
  FilledPage page() {
    if (!blocks_.empty()) throw std::invalid_argument("a block has no :end");
    end_paragraph();
    return std::move(page_);
  }

 private:
  bool is_shown() const { return blocks_.empty() || blocks_.back().is_shown; }

  static void append(std::string& paragraph, const std::string& line) {
    paragraph += (paragraph.empty() ? "" : " ") + line;
  }

  std::string filled(const std::string& text) const {
    try {
      return fmt::vformat(text, arguments_);
    } catch (const fmt::format_error& error) {
      throw std::invalid_argument(std::string(error.what()) + " in '" + text + "'");
    }
  }

  void end_paragraph() {
    const std::string text = without_line_ends(filled(paragraph_));
    if (!text.empty()) page_.text += text + "\n\n";
    paragraph_.clear();
  }

  /// A line that begins with a colon.
  void direct(const std::string& line) {
    const std::size_t blank = line.find(' ');
    const std::string word = line.substr(0, blank);
    const std::string rest = blank == std::string::npos ? "" : line.substr(blank + 1);

    if (word == ":end")
      end_block();
    else if (word == ":claim")
      begin_claim(rest);
    else if (word == ":when" || word == ":unless")
      blocks_.push_back({is_shown() && text_of(rest).empty() == (word == ":unless"), std::nullopt});
    else
      throw std::invalid_argument("unknown line '" + line + "'");
  }

  void begin_claim(const std::string& conditions) {
    if (!is_shown()) return blocks_.push_back({false, std::nullopt});
    const std::optional<std::string> refuted = refutation(conditions, texts_);
    blocks_.push_back({!refuted, refuted});
  }

  /// The left-out lines of a refuted claim are told with the condition that does not hold.
  void end_block() {
    if (blocks_.empty()) throw std::invalid_argument("an :end too many");

    if (blocks_.back().refuted)
      page_.refuted.push_back("\"" + filled(left_out_) + "\" (" + *blocks_.back().refuted + ")");

    left_out_.clear();
    blocks_.pop_back();
  }

  const std::string& text_of(const std::string& name) const {
    const auto found = texts_.find(name);
    if (found == texts_.end()) throw std::invalid_argument("no text '" + name + "'");
    return found->second;
  }

  Texts texts_;
  fmt::dynamic_format_arg_store<fmt::format_context> arguments_;
  std::vector<Block> blocks_;
  std::string paragraph_;
  std::string left_out_;  // lines of the claim that does not hold
  FilledPage page_;
};

}  // namespace

FilledPage fill(const std::string& page_template, const Texts& texts) {
  Filling filling(texts);
  std::istringstream lines(page_template);
  for (std::string line; std::getline(lines, line);) filling.add(line);
  return filling.page();
}

}  // namespace aisle::lab
