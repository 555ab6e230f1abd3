#include "services/dispatcher/dispatcher_memory.hpp"

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/process/kept_file.hpp"

namespace aisle::dispatcher {

using nlohmann::json;

namespace {

constexpr int kStages = 4;  // of a task

/// A task with its stops: those that people sent stand nowhere else.
json json_of(const TaskProgress& task) {
  json stops = json::array();
  for (const TaskStop& stop : task.task.stops) {
    const geometry::Pose2& goal = stop.goal_in_map;
    stops.push_back({{"goal_id", stop.goal_id},
                     {"pose", {goal.x, goal.y, goal.yaw}},
                     {"position_tolerance_m", stop.position_tolerance_m},
                     {"yaw_tolerance_rad", stop.yaw_tolerance_rad}});
  }

  return {{"id", task.task.id},    {"stops", stops},    {"stage", static_cast<int>(task.stage)},
          {"agv_id", task.agv_id}, {"next", task.next}, {"attempts", task.attempts}};
}

/// @throws json::exception; none for what cannot be a task's progress
std::optional<TaskProgress> task_of(const json& kept) {
  TaskProgress task;
  task.task.id = kept.at("id").get<std::string>();
  for (const json& stop : kept.at("stops")) {
    const auto pose = stop.at("pose").get<std::array<double, 3>>();
    task.task.stops.push_back({stop.at("goal_id").get<std::string>(),
                               {pose[0], pose[1], pose[2]},
                               stop.at("position_tolerance_m").get<double>(),
                               stop.at("yaw_tolerance_rad").get<double>()});
  }

  const int stage = kept.at("stage").get<int>();
  task.stage = static_cast<TaskProgress::Stage>(stage);
  task.agv_id = kept.at("agv_id").get<std::string>();
  task.next = kept.at("next").get<std::size_t>();
  task.attempts = kept.at("attempts").get<int>();

  const bool is_done = task.stage == TaskProgress::Stage::kDone;
  const bool fits = stage >= 0 && stage < kStages && task.next <= task.task.stops.size() &&
                    is_done == (task.next == task.task.stops.size());
  return fits ? std::optional(task) : std::nullopt;
}

}  // namespace

std::string to_text(const std::string& run, const DispatcherMemory& memory) {
  // One object a mission, by the vehicle's id.
  json missions = json::object();
  for (const auto& [id, p] : memory.missions) {
    missions[id] = {{"next", p.next}, {"reached", p.reached}, {"failed", p.failed}, {"stopped", p.stopped}};
  }

  json tasks = json::array();
  for (const TaskProgress& task : memory.tasks) tasks.push_back(json_of(task));

  json kept{{"run", run}, {"missions", missions}, {"tasks", tasks}, {"edits_done", memory.edits_done}};
  if (memory.started_at_ns) kept["started_at_ns"] = *memory.started_at_ns;
  return kept.dump() + "\n";
}

std::optional<DispatcherMemory> recall(const std::filesystem::path& file, const std::string& run) {
  const std::optional<std::string> text = process::read_kept_file(file);
  if (!text) return std::nullopt;

  try {
    const json kept = json::parse(*text);
    if (kept.at("run").get<std::string>() != run) return std::nullopt;

    DispatcherMemory memory;
    for (const auto& [id, p] : kept.at("missions").items()) {
      memory.missions[id] = {p.at("next").get<std::uint64_t>(), p.at("reached").get<std::uint64_t>(),
                             p.at("failed").get<std::uint64_t>(), p.at("stopped").get<bool>()};
    }

    for (const json& task : kept.value("tasks", json::array())) {
      std::optional<TaskProgress> progress = task_of(task);
      if (!progress) return std::nullopt;
      memory.tasks.push_back(std::move(*progress));
    }

    memory.edits_done = kept.at("edits_done").get<std::vector<std::string>>();
    if (kept.contains("started_at_ns")) memory.started_at_ns = kept.at("started_at_ns").get<std::int64_t>();
    return memory;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace aisle::dispatcher
