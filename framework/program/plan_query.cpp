#include "framework/program/plan_query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <stdexcept>

#include "framework/host/place.hpp"
#include "maps/cluster_tree.hpp"
#include "maps/spelling.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

constexpr std::array kCosts{CostKind::length, CostKind::time, CostKind::clearance};

CostKind cost_kind_of(const std::string& name) {
  for (const CostKind kind : kCosts)
    if (name_of(kind) == name) return kind;
  throw std::invalid_argument("cost \"" + name + "\" is not length, time or clearance" +
                              did_you_mean(name, {"length", "time", "clearance"}));
}

// The landmarks that a landmark's or a cluster's name stands for.
std::vector<LandmarkId> landmarks_called(const std::string& name, const SavedMap& map, const ClusterTree& clusters) {
  if (map.graph.find_by_name(name) == nullptr)
    if (const Cluster* const cluster = find_cluster(clusters, map.graph, name)) {
      std::vector<LandmarkId> members;
      for (const auto& [landmark, leaf] : clusters.cluster_of)
        for (ClusterId id = leaf; id != 0; id = clusters.clusters.at(id).parent)
          if (id == cluster->id) members.push_back(landmark);
      return members;
    }
  if (reads_as_place(name)) throw MalformedPlace("\"" + name + "\": only landmarks and clusters can be avoided");
  if (const Landmark* const landmark = map.graph.find_by_name(name)) return {landmark->id};
  std::vector<std::string> known;
  for (const auto& [id, landmark] : map.graph.landmarks()) known.push_back(label_of(landmark));
  for (const auto& [id, cluster] : clusters.clusters) known.push_back(label_of(cluster, map.graph));
  throw PlaceError("there is no landmark and no cluster \"" + name + "\" to avoid" + did_you_mean(name, known));
}

template <class Ids>
ordered_json labels(const Ids& ids, const char* letter) {
  ordered_json list = ordered_json::array();
  for (const auto id : ids) list.push_back(letter + std::to_string(id));
  return list;
}

ordered_json json_of(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json json_of(const std::vector<PlanPiece>& pieces) {
  ordered_json list = ordered_json::array();
  for (const PlanPiece& piece : pieces)
    list.push_back(
        {{"origin", std::string(name_of(piece.origin))}, {"route", piece.route}, {"length_m", piece.length_m}});
  return list;
}

ordered_json json_of_explanation(const PlanExplanation& explanation, CostKind kind, const SavedMap& map,
                                 const ClusterTree& clusters) {
  ordered_json passed = ordered_json::array();
  for (const auto& level : explanation.clusters) {
    ordered_json names = ordered_json::array();
    for (const ClusterId id : level) names.push_back(label_of(clusters.clusters.at(id), map.graph));
    passed.push_back(names);
  }
  return {{"levels", explanation.clusters.size()},
          {"settled_of_level", explanation.settled_of_level},
          {"clusters", passed},
          {"cost", json_of(explanation.cost)},
          {"cost_by", std::string(name_of(kind))},
          {"cost_unit", std::string(unit_of(kind))},
          {"cost_with_closed_open", json_of(explanation.cost_with_closed_open)},
          {"closed_in_the_way", explanation.closed_in_the_way}};
}

void tell_explanation(std::ostream& out, const PlanExplanation& explanation, CostKind kind, const SavedMap& map,
                      const ClusterTree& clusters) {
  const std::string cost = explanation.cost ? fmt::format("{:.2f} {}", *explanation.cost, unit_of(kind)) : "no way";
  out << fmt::format("  by {}: {}; settled", name_of(kind), cost);
  for (std::size_t level = 0; level < explanation.settled_of_level.size(); ++level) {
    const std::int64_t settled = explanation.settled_of_level[level];
    if (level == 0)
      out << fmt::format(" {} landmark{}", settled, settled == 1 ? "" : "s");
    else
      out << fmt::format(", {} at clusters of level {}", settled, level);
  }
  out << "\n";
  for (std::size_t level = explanation.clusters.size(); level-- > 0;) {
    out << fmt::format("  level {}:", level + 1);
    for (const ClusterId id : explanation.clusters[level]) out << ' ' << label_of(clusters.clusters.at(id), map.graph);
    out << "\n";
  }
  if (!explanation.cost_with_closed_open) return;
  out << fmt::format("  with every closed route open it would be {:.2f} {}, over", *explanation.cost_with_closed_open,
                     unit_of(kind));
  for (const RouteId id : explanation.closed_in_the_way) out << " R" << id;
  out << "\n";
}

// What the path is made of, in its order.
void tell_pieces(std::ostream& out, const PlanResult& result) {
  if (result.pieces.empty()) return;
  const char* between = "  made of";
  for (const PlanPiece& piece : result.pieces) {
    out << between << ' ' << name_of(piece.origin);
    if (piece.route != 0) out << " R" << piece.route;
    out << fmt::format(" {:.2f} m", piece.length_m);
    between = ",";
  }
  if (result.least_length_m) out << fmt::format("; no path can be shorter than {:.2f} m", *result.least_length_m);
  out << "\n";
}

}  // namespace

void check(const PlanQuestion& question) {
  static_cast<void>(cost_kind_of(question.cost));
  if (!question.via.empty() && question.alternatives > 0)
    throw std::invalid_argument("alternatives are known from place to place, not for a tour");
}

PlanTask task_of(const PlanQuestion& question, const SavedMap& map, const ClusterTree& clusters) {
  PlanTask task;
  task.request.from = parse_place(question.from, map.graph);
  task.request.to = parse_place(question.to, map.graph);
  for (const std::string& stop : question.via) task.via.push_back(parse_place(stop, map.graph));
  for (const std::string& name : question.avoid) {
    const auto landmarks = landmarks_called(name, map, clusters);
    task.request.avoid.insert(task.request.avoid.end(), landmarks.begin(), landmarks.end());
  }
  for (const std::string& route : question.closed) task.request.closed.push_back(parse_route(route, map.graph));
  task.request.cost = cost_kind_of(question.cost);
  task.request.alternatives = question.alternatives;
  task.request.explain = question.explain;
  return task;
}

ordered_json json_of(const PlanQuery& query, const PlanResult& result, const SavedMap& map,
                     const ClusterTree& clusters) {
  ordered_json path = ordered_json::array();
  for (const Pose2& pose : result.path) path.push_back({pose.x_m, pose.y_m, pose.theta_rad});
  ordered_json json{
      {"id", query.id},
      {"outcome", std::string(name_of(result.outcome))},
      {"reason", result.reason},
      {"cost_m", result.cost_m},
      {"length_m", result.length_m},
      {"least_length_m", json_of(result.least_length_m)},
      {"landmarks", labels(result.landmarks, "L")},
      {"routes", result.routes},
      {"path", path},
      {"clearance_m", result.clearance_m},
      {"time_ms",
       {{"graph", result.time_ms.graph_ms}, {"route", result.time_ms.route_ms}, {"total", result.time_ms.total_ms}}},
      {"settled", result.settled}};
  if (query.question.alternatives > 0) {
    ordered_json others = ordered_json::array();
    for (const PlanAlternative& other : result.alternatives)
      others.push_back(
          {{"cost_m", other.cost_m}, {"landmarks", labels(other.landmarks, "L")}, {"routes", other.routes}});
    json["alternatives"] = others;
  }
  if (query.question.explain) json["pieces"] = json_of(result.pieces);
  if (result.explanation)
    json["explanation"] = json_of_explanation(*result.explanation, cost_kind_of(query.question.cost), map, clusters);
  return json;
}

void tell_people(std::ostream& out, const PlanQuery& query, const PlanResult& result, const SavedMap& map,
                 const ClusterTree& clusters) {
  out << fmt::format("{} -> {}: {}", query.question.from, query.question.to, name_of(result.outcome));
  const bool on_grid = !map.grid.bounds().empty();
  if (result.outcome == PlanOutcome::solved)
    out << (on_grid ? fmt::format(", {:.2f} m, {:.2f} m between the robot and what is nearest, {:.1f} ms",
                                  result.length_m, result.clearance_m, result.time_ms.total_ms)
                    : fmt::format(", cost {:.2f} m, {:.3f} ms", result.cost_m, result.time_ms.total_ms));
  const auto list = [&](const std::vector<LandmarkId>& landmarks) {
    for (const LandmarkId id : landmarks) out << " L" << id;
  };
  if (!result.landmarks.empty()) {
    out << ", by way of";
    list(result.landmarks);
  }
  if (!result.reason.empty()) out << "\n  " << result.reason;
  out << "\n";
  for (const PlanAlternative& other : result.alternatives) {
    out << fmt::format("  or {:.2f} m:", other.cost_m);
    list(other.landmarks);
    out << "\n";
  }
  if (query.question.explain) tell_pieces(out, result);
  if (result.explanation) tell_explanation(out, *result.explanation, cost_kind_of(query.question.cost), map, clusters);
}

}  // namespace cairn
