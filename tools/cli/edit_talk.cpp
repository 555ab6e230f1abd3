#include "tools/cli/edit_talk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/service/hear.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

constexpr Seconds kEditAgainAfter{0.5};

/// One line for a person.
std::string text_of_result(const fleet::MapEditResult& result, const std::string& what) {
  using Outcome = fleet::MapEditResult::Outcome;
  switch (result.outcome) {
    case Outcome::kApplied:
      return fmt::format("applied: {}, the map is at revision {} now (edit {})",
                         what.empty() ? fmt::format("{} cells changed", result.changed_cells) : what, result.revision,
                         result.edit_id);
    case Outcome::kAlreadyApplied:
      return fmt::format("was applied before, in revision {} (edit {})", result.revision, result.edit_id);
    case Outcome::kRefused:
      break;
  }

  return fmt::format("refused: {} (edit {})", result.detail, result.edit_id);
}

}  // namespace

EditTalk::EditTalk(bus::Bus& bus)
    : bus_(bus),
      cell_edits_(bus.writer<topics::MapEdit>()),
      zone_edits_(bus.writer<topics::ZoneEdit>()),
      stamper_(bus, "aisle", static_cast<std::uint64_t>(bus.wall_clock_ns()) / 1000) {
  service::hear<topics::MapInfo>(bus_, {[this](const grid::MapSummary& map, const service::Sender&) {
                                          if (map_id_.empty()) map_id_ = map.map_id;
                                        },
                                        {},
                                        {}});

  service::hear<topics::MapEditResult>(bus_, {[this](const fleet::MapEditResult& result, const service::Sender& from) {
                                                if (result.edit_id == edit_id_) result_ = Answer{result, from.by};
                                              },
                                              {},
                                              {}});
}

std::string EditTalk::find_map(Seconds limit) {
  run_until(bus_, limit, [this] { return !map_id_.empty(); });
  return map_id_;
}

/// The same edit id each time: the map knows a repetition by it.
template <class Topic, class Edit>
std::optional<EditTalk::Answer> EditTalk::send(bus::Writer<Topic>& writer, const Edit& edit, Seconds limit) {
  edit_id_ = edit.edit_id;

  const auto end = std::chrono::steady_clock::now() + limit;
  while (!result_ && !is_interrupted()) {
    auto sample = wire::encode(edit);
    sample.by(stamper_.next());
    writer.write(sample);

    const Seconds left = end - std::chrono::steady_clock::now();
    run_until(bus_, std::min(left, kEditAgainAfter), [this] { return result_.has_value(); });

    if (left <= Seconds::zero()) break;
  }

  return result_;
}

/// A map first, then the edit.
template <class Topic, class Edit>
EditTalk::Answer EditTalk::apply_by(bus::Writer<Topic>& writer, Edit edit, const std::string& map_id,
                                    double timeout_s) {
  const std::string to = map_id.empty() ? find_map(Seconds(timeout_s)) : map_id;
  if (to.empty()) {
    throw config::BadEnvironment("no map seen in " + place_of(bus_.settings()) +
                                 "; is aisle-map running? aisle doctor looks for the cause");
  }

  edit.map_id = to;

  const std::optional<Answer> result = send(writer, edit, Seconds(timeout_s));
  if (!result) {
    throw config::BadEnvironment(
        fmt::format("aisle-map did not answer within {:g} s; repeat with --id {} to be sure that it is applied once",
                    timeout_s, edit.edit_id));
  }

  return *result;
}

EditTalk::Answer EditTalk::apply(const fleet::MapEdit& edit, const std::string& map_id, double timeout_s) {
  return apply_by(cell_edits_, edit, map_id, timeout_s);
}

EditTalk::Answer EditTalk::apply(const fleet::ZoneEdit& edit, const std::string& map_id, double timeout_s) {
  return apply_by(zone_edits_, edit, map_id, timeout_s);
}

/// A refusal goes to stderr.
int print_result(const Cli& cli, const EditTalk::Answer& answer, const std::string& what) {
  const bool is_refused = answer.result.outcome == fleet::MapEditResult::Outcome::kRefused;
  const int code = is_refused ? process::kNegative : process::kDone;

  if (cli.json) {
    std::printf("%s\n", write_json(json_of(answer.result, answer.by)).c_str());
  } else {
    std::fprintf(code == process::kDone ? stdout : stderr, "%s\n",
                 printable(text_of_result(answer.result, what)).c_str());
  }

  return code;
}

}  // namespace aisle::cli
