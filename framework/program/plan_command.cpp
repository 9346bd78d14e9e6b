#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <optional>

#include "framework/host/fence.hpp"
#include "framework/host/module_library.hpp"
#include "framework/host/place.hpp"
#include "framework/host/tour.hpp"
#include "framework/host/trajectory.hpp"
#include "framework/program/commands.hpp"
#include "framework/program/plan_query.hpp"
#include "framework/program/saved_radius.hpp"
#include "maps/hierarchy/hierarchies.hpp"
#include "maps/map_store.hpp"
#include "maps/pictures/map_picture.hpp"

namespace cairn {
namespace {

// A saved map with everything that one planner needs; answers any number of queries.
class MapPlanner {
 public:
  MapPlanner(const PlanCommand& command, const CommonOptions& common)
      : command_(command),
        many_(!command.queries.empty()),
        library_(plugin_folders(common.plugin_folders)),
        map_(load_map(command.map)),
        robot_(robot_of(command, map_)),
        hierarchies_(map_.graph, map_.clusters, rules_of(robot_, map_)) {
    PluginChoice choice{command.planner, {}};
    choice.config.kind = ConfigValue::Kind::map;
    choice.config.place.file = "--planner";
    ModuleContext context{robot_};
    context.seed = static_cast<std::uint64_t>(command.seed);
    context.modules = &library_;
    if (many_) static_cast<void>(hierarchies_.by(CostKind::length));  // not in the time of the first answer
    planner_ = fenced_making(choice.name, [&] { return library_.make<Planner>(choice, context); });
  }

  PlanResult answer(const PlanQuery& query) const {
    PlanTask task;
    try {
      task = task_of(query.question, map_, query.question.avoid.empty() ? ClusterTree{} : clusters());
    } catch (const PlaceError& error) {
      PlanResult unknown;
      unknown.outcome = PlanOutcome::unknown_place;
      unknown.reason = error.what();
      return unknown;
    }
    task.request.radius_m = robot_.radius_m;
    task.request.seed = static_cast<std::uint64_t>(command_.seed);
    Budget budget;
    if (command_.budget_ms)
      budget.deadline = Budget::Clock::now() + std::chrono::microseconds(std::llround(*command_.budget_ms * 1e3));
    // One answer is not worth making the hierarchy for.
    const bool on_hierarchy = many_ || task.request.explain;
    const WorldView world{map_.grid, map_.graph, robot_, {}, 0.0, nullptr, 0.0, on_hierarchy ? &hierarchies_ : nullptr};
    return plan_tour(
        [&](const PlanRequest& request) {
          return fenced("planner", command_.planner, [&] { return planner_->plan(request, world, budget); });
        },
        task.request, task.via);
  }

  // As the hierarchy has them.
  const ClusterTree& clusters() const {
    if (!clusters_) clusters_ = hierarchies_.tree();
    return *clusters_;
  }
  const SavedMap& map() const { return map_; }
  double radius_m() const { return robot_.radius_m; }
  const RobotModel& robot() const { return robot_; }

 private:
  static RobotModel robot_of(const PlanCommand& command, const SavedMap& map) {
    RobotModel robot;
    robot.radius_m = command.radius_m ? *command.radius_m : saved_radius_m(map, command.map);
    return robot;
  }
  static RouteCostRules rules_of(const RobotModel& robot, const SavedMap& map) {
    return {robot.max_v_mps, robot.max_w_radps, robot.radius_m, &map.grid};
  }

  const PlanCommand& command_;
  bool many_ = false;
  ModuleLibrary library_;
  SavedMap map_;
  RobotModel robot_;
  Hierarchies hierarchies_;
  mutable std::optional<ClusterTree> clusters_;
  std::shared_ptr<Planner> planner_;
};

// On one line. Names from the command line may be no UTF-8.
std::string text_of(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

nlohmann::ordered_json json_of(const std::vector<TrajectoryPoint>& trajectory) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const auto& [time_s, pose, v_mps, w_radps] : trajectory)
    points.push_back({time_s, pose.x_m, pose.y_m, pose.theta_rad, v_mps, w_radps});
  return points;
}

// JSON to standard output, text for people to `text` unless it is null.
void tell(const MapPlanner& planner, const PlanQuery& query, const PlanResult& result, bool json, std::ostream* text) {
  const ClusterTree& clusters = result.explanation ? planner.clusters() : planner.map().clusters;
  std::vector<TrajectoryPoint> trajectory;
  if (query.question.trajectory && result.outcome == PlanOutcome::solved)
    trajectory = trajectory_of(result.path, planner.robot());
  if (json) {
    auto answer = json_of(query, result, planner.map(), clusters);
    if (query.question.trajectory) answer["trajectory"] = json_of(trajectory);
    std::cout << text_of(answer) << "\n";
  }
  if (text != nullptr) tell_people(*text, query, result, planner.map(), clusters);
  if (text != nullptr && !trajectory.empty()) *text << fmt::format("  driven in {:.1f} s\n", trajectory.back().time_s);
}

int answer_queries(const MapPlanner& planner, const PlanCommand& command, const CommonOptions& common) {
  std::ifstream file;
  if (command.queries != "-") file.open(command.queries);
  if (command.queries != "-" && !file) throw ConfigError({command.queries, 0, 0}, "no such file");
  if (std::filesystem::is_directory(command.queries)) throw ConfigError({command.queries, 0, 0}, "is a folder");
  std::istream& in = command.queries == "-" ? std::cin : file;
  bool all_solved = true;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const PlanQuery query = query_of_line(line, command.queries, number, command.question);
    const PlanResult result = planner.answer(query);
    all_solved = all_solved && result.outcome == PlanOutcome::solved;
    tell(planner, query, result, common.json, common.json ? nullptr : &std::cout);
  }
  return all_solved ? kExitDone : kExitNotSolved;
}

void draw(const MapPlanner& planner, const PlanCommand& command, const PlanQuery& query, const PlanResult& result) {
  MapPicture picture;
  picture.grid = &planner.map().grid;
  picture.graph = &planner.map().graph;
  picture.clusters = &planner.map().clusters;
  picture.shapes = planner.map().shapes;
  for (const Pose2& pose : result.path) picture.planned.push_back(pose.position());
  if (!result.path.empty()) {
    picture.start = result.path.front().position();
    picture.goal = result.path.back().position();
  }
  picture.robot_radius_m = planner.radius_m();
  picture.title = fmt::format("{} to {}: {}", query.question.from, query.question.to, name_of(result.outcome));
  if (result.outcome == PlanOutcome::solved) picture.title += fmt::format(", {:.2f} m", result.length_m);
  write_map_picture(command.picture, picture);
}

}  // namespace

int plan(const PlanCommand& command, const CommonOptions& common) {
  if (command.queries.empty() && (command.question.from.empty() || command.question.to.empty()))
    throw std::runtime_error("plan: give --from PLACE and --to PLACE, or --queries FILE");
  if (!command.queries.empty() && !command.picture.empty())
    throw std::runtime_error("plan: --picture draws one route; give it with --from and --to");
  if (command.queries.empty()) check(command.question);
  const MapPlanner planner(command, common);
  if (!command.queries.empty()) return answer_queries(planner, command, common);
  const PlanQuery query{"", command.question};
  const PlanResult result = planner.answer(query);
  tell(planner, query, result, common.json, common.json ? &std::cerr : &std::cout);
  if (!command.picture.empty()) draw(planner, command, query, result);
  return result.outcome == PlanOutcome::solved ? kExitDone : kExitNotSolved;
}

}  // namespace cairn
