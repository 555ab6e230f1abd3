#include "common/config/yaml_guard.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <sstream>

#include "common/config/reader.hpp"

namespace aisle::config {
namespace {

/// Listens to the parser's events; nothing is built.
class Guard final : public YAML::EventHandler {
 public:
  explicit Guard(const std::string& name) : name_(name) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { refuse_anchor(mark, anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override { refuse_anchor(mark, anchor); }

  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor, const std::string&) override {
    refuse_anchor(mark, anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    enter(mark, anchor);
  }

  void OnSequenceEnd() override { --depth_; }

  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    enter(mark, anchor);
  }

  void OnMapEnd() override { --depth_; }

 private:
  /// A sequence or a map begins.
  void enter(const YAML::Mark& mark, YAML::anchor_t anchor) {
    refuse_anchor(mark, anchor);
    if (++depth_ > kDeepest) refuse(mark, "nested deeper than " + std::to_string(kDeepest) + " levels; flatten it");
  }

  void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) refuse(mark, "anchors and aliases (&, *) are not accepted; write the value out");
  }

  [[noreturn]] void refuse(const YAML::Mark& mark, const std::string& why) {
    throw BadInput(name_ + ":" + std::to_string(mark.line + 1) + ": " + why);
  }

  static constexpr int kDeepest = 32;

  const std::string& name_;
  int depth_{0};
};

}  // namespace

/// The parser calls the guard for each event; yaml-cpp builds no tree for it.
void refuse_yaml_bombs(const std::string& text, const std::string& name) {
  std::istringstream stream(text);
  Guard guard(name);
  YAML::Parser parser(stream);

  parser.HandleNextDocument(guard);

  if (parser) throw BadInput(name + ": more than one YAML document; keep one, without a second '---'");
}

}  // namespace aisle::config
