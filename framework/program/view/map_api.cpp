#include "framework/program/view/map_api.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "framework/config/config_value.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/plan/answer_line.hpp"
#include "framework/program/view/map_view.hpp"
#include "framework/program/view/shell_word.hpp"

namespace cairn {
namespace {

constexpr const char* kRequestBody = "the request";

ViewResponse json_answer(std::string text) {
  return {200, "application/json", std::move(text)};
}

}  // namespace

MapApi::MapApi(const MapPlannerOptions& plan, const CommonOptions& common)
    : library_(module_library(common)),
      planner_(plan, PlannerUse::many_at_once, library_),
      name_(plan.map.filename().string()),
      options_(shell_word(plan.map.string()) + " --planner " + shell_word(plan.planner) +
               fmt::format(" --budget-ms {}", *plan.budget_ms)) {}

std::optional<ViewResponse> MapApi::answer(const ViewRequest& request) {
  const std::scoped_lock lock(mutex_);
  const SavedMap& map = planner_.map();
  if (request.target == "/api/map") return json_answer(view_map_json(map, planner_.whole_grid(), name_));
  if (request.target == "/api/landmarks") return json_answer(view_landmarks_json(map.graph));
  if (request.target == "/api/routes") return json_answer(view_routes_json(map.graph));
  if (request.target == "/api/clusters") return json_answer(view_clusters_json(map.clusters, map.graph));
  if (request.target == "/api/plan") return plan(request.body);
  for (const int level : view_levels(planner_.whole_grid()))
    if (request.target == fmt::format("/api/grid?level={}", level))
      return ViewResponse{200, "application/octet-stream", view_cells(planner_.whole_grid(), level)};
  return std::nullopt;
}

ViewResponse MapApi::plan(const std::string& body) const {
  std::string line = body;
  std::ranges::replace(line, '\n', ' ');
  try {
    const PlanQuery query = query_of_line(line, kRequestBody, 1, {});
    const std::string answered = json_line_of(query, planner_.answer(query.question), planner_);
    const nlohmann::ordered_json command =
        "printf '%s\\n' " + shell_word(line) + " | cairn plan " + options_ + " --queries - --json";
    return json_answer("{\"command\":" + command.dump() + ",\"answer\":" + answered.substr(0, answered.size() - 1) +
                       "}\n");
  } catch (const ConfigError& error) {
    return view_error(400, error.what());
  }
}

}  // namespace cairn
