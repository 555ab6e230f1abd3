#include "tools/cli/lab_options.hpp"

#include "common/config/reader.hpp"
#include "tools/cli/coordinates.hpp"

namespace aisle::cli {
namespace {

std::optional<lab::Place> typed_place(const char* flag, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const TypedPose typed = parse_pose(flag, text);
  return lab::Place{typed.in_map.position(), typed.has_yaw ? std::optional(typed.in_map.yaw) : std::nullopt};
}

bool counts(const lab::ParameterValue& value, const lab::InUse& in_use) {
  try {
    lab::check_in_use("", {value}, in_use);
  } catch (const config::BadInput&) {
    return false;
  }
  return true;
}

}  // namespace

void add_map_flags(Verb& verb, MapFlags& flags) {
  verb.option("--map", flags.map,
              "your own map: a picture (.png, .pgm), ROS .yaml, Moving AI .map, or text .txt with #, ., S and T")
      .option("--resolution", flags.resolution_m, 0.001, 1000.0,
              "m a pixel or cell; a picture needs it, text and Moving AI have 1 without it")
      .option("--start", flags.start, "X,Y in metres in the map's frame, or X,Y,YAW; default: the map's S")
      .option("--goal", flags.goal,
              "X,Y or X,Y,YAW; default: the map's T; in a drive as printed its YAW does not count")
      .option("--scen", flags.scen, "Moving AI scenarios (.scen), or lines of sx sy gx gy optimum (.q)")
      .option("--limit", flags.limit, 1, 1'000'000, "at most so many scenarios, evenly spread over the file");
}

lab::SubjectOrders subject_orders_of(const MapFlags& flags) {
  return {flags.map,
          flags.resolution_m,
          typed_place("--start", flags.start),
          typed_place("--goal", flags.goal),
          flags.scen,
          static_cast<std::size_t>(flags.limit)};
}

std::vector<Typed> typed_place_flags(const MapFlags& flags) {
  return {{"--resolution", flags.resolution_m > 0.0},
          {"--start", !flags.start.empty()},
          {"--goal", !flags.goal.empty()},
          {"--scen", !flags.scen.empty()},
          {"--limit", flags.limit != MapFlags{}.limit}};
}

void refuse_typed(const std::vector<Typed>& flags, const std::string& why) {
  for (const Typed& it : flags)
    if (it.is_given) throw config::BadInput(std::string(it.flag) + ": " + why);
}

lab::Row head_rows(const MapFlags& flags) {
  const auto typed = [](const std::string& text) { return text.empty() ? lab::Row(nullptr) : lab::Row(text); };
  return {{"resolution_m", flags.resolution_m > 0.0 ? lab::Row(flags.resolution_m) : lab::Row(nullptr)},
          {"start", typed(flags.start)},
          {"goal", typed(flags.goal)},
          {"scen", typed(flags.scen)},
          {"limit", flags.limit != MapFlags{}.limit ? lab::Row(flags.limit) : lab::Row(nullptr)}};
}

void add_parameter_flags(Verb& verb, ParameterFlags& flags) {
  verb.list("--set", flags.sets,
            "NAME.PARAMETER=VALUE of a planner, e.g. wang.alpha=0.1; several times; aisle lab parameters lists all")
      .option("--parameters", flags.file, "a YAML file of the same, e.g. local: {wang: {alpha: 0.1}}");
}

std::vector<lab::ParameterValue> parameters_of(const ParameterFlags& flags, const lab::InUse& in_use,
                                               std::optional<lab::Side> only) {
  std::vector<lab::ParameterValue> values;
  if (!flags.file.empty()) {
    for (const lab::ParameterValue& value : lab::read_parameter_file(flags.file))
      if (counts(value, in_use)) values.push_back(value);
  }

  for (const std::string& text : flags.sets) {
    values.push_back(lab::parse_parameter("--set", text, only));
    lab::check_in_use("--set", {values.back()}, in_use);
  }

  return values;
}

std::string listed_values(const std::vector<lab::ParameterValue>& values) {
  std::string text;
  for (const lab::ParameterValue& value : values)
    text += (text.empty() ? "" : ", ") + value.full_name() + "=" + value.value;
  return text;
}

}  // namespace aisle::cli
