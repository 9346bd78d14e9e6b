#include "framework/planning/plan_answer.hpp"

#include <nlohmann/json.hpp>

#include "framework/planning/plan_task.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

template <class Ids>
ordered_json labels(const Ids& ids, const char* letter) {
  ordered_json list = ordered_json::array();
  for (const auto id : ids) list.push_back(letter + std::to_string(id));
  return list;
}

ordered_json json_of(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json json_of(const std::vector<PathSegment>& segments) {
  ordered_json list = ordered_json::array();
  for (const PathSegment& segment : segments)
    list.push_back(
        {{"origin", std::string(name_of(segment.origin))}, {"route", segment.route}, {"length_m", segment.length_m}});
  return list;
}

ordered_json json_of_explanation(const RouteExplanation& explanation, CostKind kind, const LandmarkGraph& graph,
                                 const ClusterTree& clusters) {
  ordered_json passed = ordered_json::array();
  for (const auto& level : explanation.clusters) {
    ordered_json names = ordered_json::array();
    for (const ClusterId id : level) names.push_back(label_of(clusters.clusters.at(id), graph));
    passed.push_back(names);
  }
  return {{"search", explanation.search},
          {"search_level", explanation.search_level},
          {"search_reason", explanation.search_reason},
          {"levels", explanation.clusters.size()},
          {"settled_of_level", explanation.settled_of_level},
          {"clusters", passed},
          {"cost", json_of(explanation.cost)},
          {"cost_by", std::string(name_of(kind))},
          {"cost_unit", std::string(unit_of(kind))},
          {"cost_with_closed_open", json_of(explanation.cost_with_closed_open)},
          {"closed_on_cheaper_path", explanation.closed_on_cheaper_path}};
}

ordered_json json_of(const std::vector<RouteAlternative>& alternatives) {
  ordered_json list = ordered_json::array();
  for (const RouteAlternative& other : alternatives)
    list.push_back({{"cost_m", other.cost_m}, {"landmarks", labels(other.landmarks, "L")}, {"routes", other.routes}});
  return list;
}

ordered_json json_of(const PlanTimes& times) {
  return {{"graph", times.graph_ms}, {"route", times.route_ms}, {"total", times.total_ms}};
}

ordered_json json_of(const std::vector<TrajectoryPoint>& trajectory) {
  ordered_json points = ordered_json::array();
  for (const auto& [time_s, pose, v_mps, w_radps] : trajectory)
    points.push_back({time_s, pose.x_m, pose.y_m, pose.theta_rad, v_mps, w_radps});
  return points;
}

}  // namespace

std::string json_text_of(const PlanAnswer& answer) {
  const PlanResult& result = answer.result;
  ordered_json path = ordered_json::array();
  for (const Pose2& pose : result.path) path.push_back({pose.x_m, pose.y_m, pose.theta_rad});
  ordered_json json{{"id", ordered_json::parse(answer.id_json)},
                    {"outcome", std::string(name_of(result.outcome))},
                    {"reason", result.reason},
                    {"cost_m", result.cost_m},
                    {"length_m", result.length_m},
                    {"length_lower_bound_m", json_of(result.length_lower_bound_m)},
                    {"landmarks", labels(result.landmarks, "L")},
                    {"routes", result.routes},
                    {"path", std::move(path)},
                    {"clearance_m", result.clearance_m},
                    {"margin_m", result.margin_m},
                    {"driving_time_s", json_of(result.driving_time_s)}};
  if (answer.with_times) json["time_ms"] = json_of(result.time_ms);
  json["settled"] = result.settled;
  if (answer.question.alternatives > 0) json["alternatives"] = json_of(result.alternatives);
  if (answer.question.explain) json["segments"] = json_of(result.segments);
  if (result.explanation)
    json["explanation"] =
        json_of_explanation(*result.explanation, cost_kind_of(answer.question.cost), answer.graph, answer.clusters);
  if (answer.question.trajectory) json["trajectory"] = json_of(answer.trajectory);
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace cairn
