#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/host/fence.hpp"
#include "framework/host/module_library.hpp"
#include "framework/host/place.hpp"
#include "framework/program/commands.hpp"
#include "framework/program/saved_radius.hpp"
#include "maps/map_store.hpp"
#include "maps/pictures/map_picture.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

struct Query {
  nlohmann::json id = "";  // as it came: text or number
  std::string from;
  std::string to;
};

// A saved map with everything that one planner needs; answers any number of queries.
class MapPlanner {
 public:
  MapPlanner(const PlanCommand& command, const CommonOptions& common)
      : command_(command), library_(plugin_folders(common.plugin_folders)), map_(load_map(command.map)) {
    robot_.radius_m = command.radius_m ? *command.radius_m : saved_radius_m(map_, command.map);
    PluginChoice choice{command.planner, {}};
    choice.config.kind = ConfigValue::Kind::map;
    choice.config.place.file = "--planner";
    ModuleContext context{robot_};
    context.seed = static_cast<std::uint64_t>(command.seed);
    context.modules = &library_;
    planner_ = fenced_making(choice.name, [&] { return library_.make<Planner>(choice, context); });
  }

  PlanResult answer(const Query& query) const {
    PlanRequest request;
    PlanResult unknown;
    unknown.outcome = PlanOutcome::unknown_place;
    try {
      request.from = parse_place(query.from, map_.graph);
      request.to = parse_place(query.to, map_.graph);
    } catch (const PlaceError& error) {
      unknown.reason = error.what();
      return unknown;
    }
    request.radius_m = robot_.radius_m;
    request.seed = static_cast<std::uint64_t>(command_.seed);
    Budget budget;
    if (command_.budget_ms)
      budget.deadline = Budget::Clock::now() + std::chrono::microseconds(std::llround(*command_.budget_ms * 1e3));
    const WorldView world{map_.grid, map_.graph, robot_, {}, 0.0, nullptr, 0.0};
    return fenced("planner", command_.planner, [&] { return planner_->plan(request, world, budget); });
  }

  const SavedMap& map() const { return map_; }
  double radius_m() const { return robot_.radius_m; }

 private:
  const PlanCommand& command_;
  ModuleLibrary library_;
  SavedMap map_;
  RobotModel robot_;
  std::shared_ptr<Planner> planner_;
};

ordered_json json_of(const Query& query, const PlanResult& result) {
  ordered_json landmarks = ordered_json::array();
  for (const LandmarkId id : result.landmarks) landmarks.push_back("L" + std::to_string(id));
  ordered_json path = ordered_json::array();
  for (const Pose2& pose : result.path) path.push_back({pose.x_m, pose.y_m, pose.theta_rad});
  return {
      {"id", query.id},
      {"outcome", std::string(name_of(result.outcome))},
      {"reason", result.reason},
      {"cost_m", result.cost_m},
      {"length_m", result.length_m},
      {"landmarks", landmarks},
      {"path", path},
      {"clearance_m", result.clearance_m},
      {"time_ms",
       {{"graph", result.time_ms.graph_ms}, {"route", result.time_ms.route_ms}, {"total", result.time_ms.total_ms}}},
      {"settled", result.settled}};
}

void tell_people(std::ostream& out, const Query& query, const PlanResult& result) {
  out << fmt::format("{} -> {}: {}", query.from, query.to, name_of(result.outcome));
  if (result.outcome == PlanOutcome::solved)
    out << fmt::format(", {:.2f} m, {:.2f} m between the robot and what is nearest, {:.1f} ms", result.length_m,
                       result.clearance_m, result.time_ms.total_ms);
  if (!result.landmarks.empty()) {
    out << ", by way of";
    for (const LandmarkId id : result.landmarks) out << " L" << id;
  }
  if (!result.reason.empty()) out << "\n  " << result.reason;
  out << "\n";
}

Query query_of(const std::string& line, const std::string& file, int number) {
  const SourcePlace place{file, number, 1};
  const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
  if (json.is_discarded() || !json.is_object())
    throw ConfigError(place, "expected one JSON object {\"id\", \"from\", \"to\"} a line");
  for (const char* key : {"from", "to"})
    if (!json.contains(key) || !json[key].is_string())
      throw ConfigError(place, std::string("a query needs the text \"") + key + "\"");
  Query query{"", json["from"], json["to"]};
  if (json.contains("id")) query.id = json["id"];
  return query;
}

int answer_queries(const MapPlanner& planner, const PlanCommand& command, const CommonOptions& common) {
  std::ifstream file;
  if (command.queries != "-") file.open(command.queries);
  if (command.queries != "-" && !file) throw ConfigError({command.queries, 0, 0}, "no such file");
  std::istream& in = command.queries == "-" ? std::cin : file;
  bool all_solved = true;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const Query query = query_of(line, command.queries, number);
    const PlanResult result = planner.answer(query);
    all_solved = all_solved && result.outcome == PlanOutcome::solved;
    if (common.json)
      std::cout << json_of(query, result).dump() << "\n";
    else
      tell_people(std::cout, query, result);
  }
  return all_solved ? kExitDone : kExitNotSolved;
}

void draw(const MapPlanner& planner, const PlanCommand& command, const Query& query, const PlanResult& result) {
  MapPicture picture;
  picture.grid = &planner.map().grid;
  picture.graph = &planner.map().graph;
  picture.shapes = planner.map().shapes;
  for (const Pose2& pose : result.path) picture.planned.push_back(pose.position());
  if (!result.path.empty()) {
    picture.start = result.path.front().position();
    picture.goal = result.path.back().position();
  }
  picture.robot_radius_m = planner.radius_m();
  picture.title = fmt::format("{} to {}: {}", query.from, query.to, name_of(result.outcome));
  if (result.outcome == PlanOutcome::solved) picture.title += fmt::format(", {:.2f} m", result.length_m);
  write_map_picture(command.picture, picture);
}

}  // namespace

int plan(const PlanCommand& command, const CommonOptions& common) {
  if (command.queries.empty() && (command.from.empty() || command.to.empty()))
    throw std::runtime_error("plan: give --from PLACE and --to PLACE, or --queries FILE");
  if (!command.queries.empty() && !command.picture.empty())
    throw std::runtime_error("plan: --picture draws one route; give it with --from and --to");
  const MapPlanner planner(command, common);
  if (!command.queries.empty()) return answer_queries(planner, command, common);
  const Query query{"", command.from, command.to};
  const PlanResult result = planner.answer(query);
  if (common.json) std::cout << json_of(query, result).dump() << "\n";
  tell_people(common.json ? std::cerr : std::cout, query, result);
  if (!command.picture.empty()) draw(planner, command, query, result);
  return result.outcome == PlanOutcome::solved ? kExitDone : kExitNotSolved;
}

}  // namespace cairn
