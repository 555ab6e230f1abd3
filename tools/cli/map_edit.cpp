// aisle map block, aisle map unblock: edits the site's map, and waits for what aisle-map made of it.

#include <memory>
#include <string>

#include "tools/cli/cli.hpp"
#include "tools/cli/edit_shape.hpp"
#include "tools/cli/edit_talk.hpp"

namespace aisle::cli {
namespace {

/// The flags with their defaults.
struct EditOptions {
  TypedShape shape;
  std::string edit_id;
  std::string map_id;
  double timeout_s{10.0};
};

/// The typed shape as an edit, sent to the map.
int edit_map(const Cli& cli, const EditOptions& options, fleet::MapEdit::Action action) {
  fleet::MapEdit edit;
  edit.edit_id = options.edit_id.empty() ? unique_id("aisle") : options.edit_id;
  edit.action = action;
  set_shape(options.shape, edit);

  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-map-edit");
  return print_result(cli, EditTalk(*bus).apply(edit, options.map_id, options.timeout_s));
}

/// Block and unblock differ in their action only.
void add_edit_verb(CLI::App& parent, Cli& cli, const char* name, const char* purpose, fleet::MapEdit::Action action) {
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
  add_edit_verb(parent, cli, "block", "close an area for all vehicles; exit code 1 when it is refused",
                fleet::MapEdit::Action::kBlock);
}

void add_map_unblock(CLI::App& parent, Cli& cli) {
  add_edit_verb(parent, cli, "unblock", "open an area that was closed; exit code 1 when it is refused",
                fleet::MapEdit::Action::kUnblock);
}

}  // namespace aisle::cli
