#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/config/config_value.hpp"
#include "framework/planning/saved_map/map_planner.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/interrupt.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/plan/answer_line.hpp"
#include "framework/program/view/map_view.hpp"
#include "framework/program/view/page_files.hpp"
#include "framework/program/view/view_server.hpp"

namespace cairn {
namespace {

constexpr const char* kRequestBody = "the request";

// As one word of a shell.
std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

class MapApi {
 public:
  MapApi(const ViewCommand& command, const MapPlannerOptions& plan, const CommonOptions& common)
      : library_(module_library(common)),
        planner_(plan, PlannerUse::many_at_once, library_),
        name_(command.map.filename().string()) {
    options_ = shell_word(plan.map.string()) + " --planner " + shell_word(plan.planner) +
               fmt::format(" --budget-ms {}", *plan.budget_ms);
  }

  [[nodiscard]] ViewResponse answer(const ViewRequest& request) const {
    if (const auto file = page_file(request.target)) return *file;
    const SavedMap& map = planner_.map();
    if (request.target == "/api/map") return json(view_map_json(map, planner_.whole_grid(), name_));
    if (request.target == "/api/landmarks") return json(view_landmarks_json(map.graph));
    if (request.target == "/api/routes") return json(view_routes_json(map.graph));
    if (request.target == "/api/clusters") return json(view_clusters_json(map.clusters, map.graph));
    if (request.target == "/api/plan") return plan(request.body);
    for (const int level : view_levels(planner_.whole_grid()))
      if (request.target == fmt::format("/api/grid?level={}", level))
        return {200, "application/octet-stream", view_cells(planner_.whole_grid(), level)};
    return view_error(404, "there is nothing of that name");
  }

 private:
  static ViewResponse json(std::string text) { return {200, "application/json", std::move(text)}; }

  [[nodiscard]] ViewResponse plan(const std::string& body) const {
    std::string line = body;
    std::ranges::replace(line, '\n', ' ');
    try {
      const PlanQuery query = query_of_line(line, kRequestBody, 1, {});
      const std::string answered = json_line_of(query, planner_.answer(query.question), planner_);
      const nlohmann::ordered_json command =
          "printf '%s\\n' " + shell_word(line) + " | cairn plan " + options_ + " --queries - --json";
      return json("{\"command\":" + command.dump() + ",\"answer\":" + answered.substr(0, answered.size() - 1) + "}\n");
    } catch (const ConfigError& error) {
      return view_error(400, error.what());
    }
  }

  ModuleLibrary library_;
  MapPlanner planner_;
  std::string name_;
  std::string options_;
};

// The map itself, or the only one in a finished run's folder.
std::filesystem::path map_of(const std::filesystem::path& named) {
  if (!std::filesystem::is_directory(named)) return named;
  std::vector<std::filesystem::path> maps;
  for (const auto& entry : std::filesystem::directory_iterator(named))
    if (entry.path().extension() == ".cairn") maps.push_back(entry.path());
  if (maps.size() == 1) return maps.front();
  throw std::runtime_error(
      fmt::format("view: {} holds {} saved maps (*.cairn); name one", named.string(), maps.empty() ? "no" : "several"));
}

}  // namespace

int view(const ViewCommand& command, const CommonOptions& common) {
  MapPlannerOptions plan;
  plan.map = map_of(command.map);
  plan.planner = command.planner;
  plan.budget_ms = command.budget_ms;
  const MapApi api(command, plan, common);
  const std::string token = new_view_token();
  ViewServer server(command.port, token, [&](const ViewRequest& request) { return api.answer(request); });
  std::cout << fmt::format("http://127.0.0.1:{}/#t={}\n", server.port(), token) << std::flush;
  server.run(cancel_on_interrupt());
  return kExitDone;
}

}  // namespace cairn
