#include "tools/cli/edit_talk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "tools/cli/json/json.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

constexpr Seconds kEditAgainAfter{0.5};

std::string text_of_result(const aisle::MapEditResult& result) {
  const std::string id = result.edit_id().to_string();
  switch (result.outcome()) {
    case EditOutcome::EDIT_APPLIED:
      return fmt::format("applied: {} cells changed, the map is at revision {} now (edit {})", result.changed_cells(),
                         result.revision(), id);
    case EditOutcome::EDIT_ALREADY_APPLIED:
      return fmt::format("was applied before, in revision {} (edit {})", result.revision(), id);
    default:
      return fmt::format("refused: {} (edit {})", result.detail().to_string(), id);
  }
}

}  // namespace

EditTalk::EditTalk(bus::Bus& bus)
    : bus_(bus),
      writer_(bus.writer<topics::MapEdit>()),
      stamper_(bus, "aisle", static_cast<std::uint64_t>(bus.wall_clock_ns()) / 1000) {
  bus_.on<topics::MapInfo>([this](const aisle::MapInfo& sample, const bus::SampleInfo& info) {
    if (info.kind == bus::SampleKind::kData && map_id_.empty()) map_id_ = sample.map_id().to_string();
  });
  bus_.on<topics::MapEditResult>([this](const aisle::MapEditResult& sample, const bus::SampleInfo& info) {
    if (info.kind == bus::SampleKind::kData && sample.edit_id().to_string() == edit_id_) result_ = sample;
  });
}

std::string EditTalk::find_map(Seconds limit) {
  run_until(bus_, limit, [this] { return !map_id_.empty(); });
  return map_id_;
}

std::optional<aisle::MapEditResult> EditTalk::send(aisle::MapEdit edit, Seconds limit) {
  edit_id_ = edit.edit_id().to_string();
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!result_ && !is_interrupted()) {
    edit.by(stamper_.next());
    writer_.write(edit);
    const Seconds left = end - std::chrono::steady_clock::now();
    run_until(bus_, std::min(left, kEditAgainAfter), [this] { return result_.has_value(); });
    if (left <= Seconds::zero()) break;
  }
  return result_;
}

aisle::MapEditResult EditTalk::apply(aisle::MapEdit edit, const std::string& map_id, double timeout_s) {
  const std::string to = map_id.empty() ? find_map(Seconds(timeout_s)) : map_id;
  if (to.empty()) {
    throw config::BadEnvironment("no map seen in " + place_of(bus_.settings()) +
                                 "; is aisle-map running? aisle doctor looks for the cause");
  }
  edit.map_id(to);
  const std::optional<aisle::MapEditResult> result = send(edit, Seconds(timeout_s));
  if (!result) {
    throw config::BadEnvironment(
        fmt::format("aisle-map did not answer within {:g} s; repeat with --id {} to be sure that it is applied once",
                    timeout_s, edit.edit_id().to_string()));
  }
  return *result;
}

int print_result(const Cli& cli, const aisle::MapEditResult& result) {
  const int code = result.outcome() == EditOutcome::EDIT_REFUSED ? process::kNegative : process::kDone;
  if (cli.json) {
    std::printf("%s\n", write_json(to_json(result)).c_str());
  } else {
    std::fprintf(code == process::kDone ? stdout : stderr, "%s\n", printable(text_of_result(result)).c_str());
  }
  return code;
}

}  // namespace aisle::cli
