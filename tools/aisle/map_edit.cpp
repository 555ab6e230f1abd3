// aisle map block, aisle map unblock: edits the site's map, and waits for what aisle-map made of it.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "common/bus/topics.hpp"
#include "common/config/reader.hpp"
#include "common/process/clock.hpp"
#include "common/process/exit_code.hpp"
#include "common/service/origin_stamper.hpp"
#include "tools/aisle/cli.hpp"
#include "tools/aisle/edit_shape.hpp"
#include "tools/aisle/json/json.hpp"
#include "tools/aisle/text.hpp"

namespace aisle::cli {
namespace {

struct EditOptions {
  TypedShape shape;
  std::string edit_id;
  std::string map_id;
  double timeout_s{10.0};
};

constexpr Seconds kEditAgainAfter{0.5};

class EditTalk {
 public:
  explicit EditTalk(const Cli& cli)
      : bus_(join(cli, "aisle-map-edit")),
        writer_(bus_->writer<topics::MapEdit>()),
        stamper_("aisle", static_cast<std::uint64_t>(process::wall_clock_ns()) / 1000) {
    bus_->on<topics::MapInfo>([this](const aisle::MapInfo& sample, const bus::SampleInfo& info) {
      if (info.kind == bus::SampleKind::kData && map_id_.empty()) map_id_ = sample.map_id().to_string();
    });
    bus_->on<topics::MapEditResult>([this](const aisle::MapEditResult& sample, const bus::SampleInfo& info) {
      if (info.kind == bus::SampleKind::kData && sample.edit_id().to_string() == edit_id_) result_ = sample;
    });
  }
  /// Empty when no map is seen in time.
  std::string find_map(Seconds limit) {
    run_until(*bus_, limit, [this] { return !map_id_.empty(); });
    return map_id_;
  }
  /// Repeats the edit, which aisle-map applies once, until its result comes.
  std::optional<aisle::MapEditResult> apply(aisle::MapEdit edit, Seconds limit) {
    edit_id_ = edit.edit_id().to_string();
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!result_ && !is_interrupted()) {
      edit.by(stamper_.next());
      writer_.write(edit);
      const Seconds left = end - std::chrono::steady_clock::now();
      run_until(*bus_, std::min(left, kEditAgainAfter), [this] { return result_.has_value(); });
      if (left <= Seconds::zero()) break;
    }
    return result_;
  }

 private:
  std::unique_ptr<bus::Bus> bus_;
  bus::Writer<topics::MapEdit> writer_;
  service::OriginStamper stamper_;
  std::string map_id_;
  std::string edit_id_;
  std::optional<aisle::MapEditResult> result_;
};

std::string text_of_result(const aisle::MapEditResult& result) {
  const std::string id = result.edit_id().to_string();
  switch (result.outcome()) {
    case EditOutcome::EDIT_APPLIED:
      return fmt::format("applied: {} cells changed, the map is at revision {} now (edit {})", result.changed_cells(), result.revision(), id);
    case EditOutcome::EDIT_ALREADY_APPLIED:
      return fmt::format("was applied before, in revision {} (edit {})", result.revision(), id);
    default:
      return fmt::format("refused: {} (edit {})", result.detail().to_string(), id);
  }
}

int edit_map(const Cli& cli, const EditOptions& options, EditAction action) {
  aisle::MapEdit edit;
  edit.edit_id(options.edit_id.empty() ? unique_id("aisle") : options.edit_id);
  edit.action(action);
  edit.radius_m(0.0);
  set_shape(options.shape, edit);
  EditTalk talk(cli);
  const std::string map_id = options.map_id.empty() ? talk.find_map(Seconds(options.timeout_s)) : options.map_id;
  if (map_id.empty()) {
    throw config::BadEnvironment("no map seen in " + place_of(cli.settings) + "; is aisle-map running? aisle doctor looks for the cause");
  }
  edit.map_id(map_id);
  const std::optional<aisle::MapEditResult> result = talk.apply(edit, Seconds(options.timeout_s));
  if (!result) {
    throw config::BadEnvironment(fmt::format("aisle-map did not answer within {:g} s; repeat with --id {} to be sure that it is applied once",
                                             options.timeout_s, edit.edit_id().to_string()));
  }
  const int code = result->outcome() == EditOutcome::EDIT_REFUSED ? process::kNegative : process::kDone;
  if (cli.json) {
    std::printf("%s\n", write_json(to_json(*result)).c_str());
  } else {
    std::fprintf(code == process::kDone ? stdout : stderr, "%s\n", printable(text_of_result(*result)).c_str());
  }
  return code;
}

void add_edit_verb(CLI::App& parent, Cli& cli, const char* name, const char* purpose, EditAction action) {
  auto options = std::make_shared<EditOptions>();
  Verb(parent, cli, name, purpose)
      .option("--rect", options->shape.rectangle, "x1,y1,x2,y2: two opposite corners, metres")
      .option("--disc", options->shape.disc, "x,y,radius: metres")
      .list("--polygon", options->shape.polygon, "x,y x,y x,y ...: 3 to 64 corners, metres")
      .option("--id", options->edit_id, "id of the edit: the same id is applied once; one is made when not given")
      .option("--map", options->map_id, "id of the map; the one that is seen when not given")
      .option("--timeout", options->timeout_s, 0.1, 1e6, "give up after so many seconds")
      .runs([&cli, options, action] { return edit_map(cli, *options, action); });
}

}  // namespace

void add_map_block(CLI::App& parent, Cli& cli) {
  add_edit_verb(parent, cli, "block", "close an area for all vehicles; exit code 1 when it is refused", EditAction::EDIT_BLOCK);
}

void add_map_unblock(CLI::App& parent, Cli& cli) {
  add_edit_verb(parent, cli, "unblock", "open an area that was closed; exit code 1 when it is refused", EditAction::EDIT_UNBLOCK);
}

}  // namespace aisle::cli
