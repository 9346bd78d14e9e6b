#include "framework/program/mission/watch_text.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/behaviour_tree/tree_text.hpp"
#include "framework/program/mission/clusters_json.hpp"
#include "framework/program/mission/status_json.hpp"
#include "maps/base/base64.hpp"

namespace cairn {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;

std::string watch_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Tenths of a millimetre and of a milliradian: null where it is no number.
Json watch_number(double value) {
  return std::isfinite(value) ? Json(std::round(value * 1e4) / 1e4) : Json(nullptr);
}

Json watch_json(const Point& point) {
  return {watch_number(point.x()), watch_number(point.y())};
}

Json watch_json(const Pose2& pose) {
  return {watch_number(pose.x_m), watch_number(pose.y_m), watch_number(pose.theta_rad)};
}

Json watch_points(const std::vector<Pose2>& path) {
  Json points = Json::array();
  for (const Pose2& pose : path) points.push_back(watch_json(pose.position()));
  return points;
}

Json watch_json(const std::vector<TreeNode>& nodes) {
  Json list = Json::array();
  for (const TreeNode& node : nodes)
    list.push_back({{"path", node.path},
                    {"kind", node.choice.name},
                    {"name", node.name},
                    {"settings", settings_text(node)},
                    {"children", watch_json(node.children)}});
  return list;
}

Json watch_json(const PoseEstimate& pose) {
  const Eigen::Matrix3d& c = pose.covariance;
  return {{"x_m", watch_number(pose.T_map_robot.x_m)},
          {"y_m", watch_number(pose.T_map_robot.y_m)},
          {"theta_rad", watch_number(pose.T_map_robot.theta_rad)},
          {"covariance", {c(0, 0), c(0, 1), c(1, 1), c(2, 2)}},
          {"trust", std::string(name_of(pose.trust))}};
}

std::string_view watch_state(double range_m) {
  if (std::isnan(range_m)) return "bad";
  if (std::isfinite(range_m)) return "echo";
  return range_m > 0.0 ? "no_echo" : "too_near";
}

// Where the transducer is in the map, half its beam, and how far it has seen.
Json watch_json(const std::vector<ShownRange>& ranges) {
  Json list = Json::array();
  for (const auto& [time_s, T_map_sensor, reading] : ranges) {
    const double range_m = std::isfinite(reading.range_m) ? reading.range_m : reading.max_m;
    list.push_back({watch_number(T_map_sensor.x_m), watch_number(T_map_sensor.y_m),
                    watch_number(T_map_sensor.theta_rad), watch_number(reading.half_beam_rad), watch_number(range_m),
                    std::string(watch_state(reading.range_m))});
  }
  return list;
}

Json watch_json(const Landmark& landmark) {
  Json evidence = Json::array();
  for (const CategoryEvidence& one : landmark.evidence)
    evidence.push_back({one.category, one.matchings, watch_number(one.mean_degree)});
  return {{"id", landmark.id},
          {"label", label_of(landmark)},
          {"category", landmark.category},
          {"x", watch_number(landmark.T_map_landmark.x_m)},
          {"y", watch_number(landmark.T_map_landmark.y_m)},
          {"degree", watch_number(landmark.degree)},
          {"sightings", landmark.sightings},
          {"evidence", std::move(evidence)}};
}

Json watch_json(const std::vector<Route>& routes) {
  Json list = Json::array();
  for (const Route& route : routes)
    list.push_back({{"id", route.id},
                    {"from", route.from},
                    {"to", route.to},
                    {"driven", route.driven},
                    {"closed", route.closed},
                    {"points", watch_points(route.trajectory)}});
  return list;
}

Json watch_json(const std::vector<GridTile>& tiles) {
  Json list = Json::array();
  for (const GridTile& tile : tiles) list.push_back({tile.tile.x, tile.tile.y, base64(tile.ol)});
  return list;
}

Json watch_json(const std::vector<WatchLine>& lines) {
  Json list = Json::array();
  for (const WatchLine& line : lines) list.push_back({watch_number(line.time_s), line.sentence});
  return list;
}

Json watch_json(const std::vector<StageTime>& times) {
  Json list = Json::array();
  for (const StageTime& one : times) list.push_back({one.stage, one.module, one.count, watch_number(one.own_s)});
  return list;
}

Json watch_json(const WatchPlan& plan) {
  return {{"time_s", watch_number(plan.time_s)},
          {"outcome", std::string(name_of(plan.result.outcome))},
          {"reason", plan.result.reason},
          {"length_m", watch_number(plan.result.length_m)},
          {"points", watch_points(plan.result.path)}};
}

Json watch_json(const CellBox& box) {
  return {{"x", box.min.x}, {"y", box.min.y}, {"width", box.width()}, {"height", box.height()}};
}

std::string watch_state(const NodeReport& node) {
  if (node.is_running) return "running";
  if (node.is_halted) return "halted";
  return node.status.state == StepState::success ? "success" : "failure";
}

void add_watched_state(Json& line, const WatchFrame& frame) {
  line["time_s"] = watch_number(frame.time_s);
  line["paused"] = frame.is_paused;
  line["pose"] = watch_json(frame.pose);
  line["commanded"] = {watch_number(frame.commanded.v_mps), watch_number(frame.commanded.w_radps)};
  if (frame.truth) line["truth"] = watch_json(*frame.truth);
  line["ranges"] = watch_json(frame.ranges);
  if (frame.status) line["status"] = json_of(*frame.status);
}

void add_watched_map(Json& line, const WatchFrame& frame) {
  if (!frame.tiles.empty()) line["tiles"] = watch_json(frame.tiles);
  if (!frame.landmarks.empty()) {
    line["landmarks"] = Json::array();
    for (const Landmark& landmark : frame.landmarks) line["landmarks"].push_back(watch_json(landmark));
  }
  if (!frame.retired.empty()) line["retired"] = frame.retired;
  if (frame.routes) line["routes"] = watch_json(*frame.routes);
  if (frame.clusters) line["clusters"] = json_of(*frame.clusters);
  if (frame.has_more) line["more"] = true;
}

}  // namespace

std::string WatchText::first_line(const std::string& mission, const std::vector<TreeNode>& steps,
                                  double robot_radius_m) {
  return watch_line({{"ok", true},
                     {"watch", kFormat},
                     {"mission", mission},
                     {"robot_radius_m", watch_number(robot_radius_m)},
                     {"tree", watch_json(steps)}});
}

std::string WatchText::line_of(const WatchFrame& frame) {
  Json line{{"tick", frame.tick}};
  if (frame.is_afresh) line["afresh"] = true;
  if (!frame.is_last) add_watched_state(line, frame);
  if (frame.cell_m > 0.0 && (frame.is_afresh || frame.bounds != bounds_))
    line["grid"] = {
        {"cell_m", frame.cell_m}, {"origin_m", watch_json(frame.origin_m)}, {"box", watch_json(frame.bounds)}};
  bounds_ = frame.bounds;
  add_watched_map(line, frame);
  if (frame.plan != plan_) line["plan"] = frame.plan ? watch_json(*frame.plan) : Json(nullptr);
  plan_ = frame.plan;
  Json nodes = Json::array();
  for (const NodeReport& node : frame.nodes) {
    NodeState now{watch_state(node), node.is_running ? node.doing : node.status.reason};
    NodeState& before = nodes_[node.path];
    if (before == now) continue;
    before = std::move(now);
    nodes.push_back({node.path, before.first, before.second});
  }
  if (!nodes.empty()) line["nodes"] = std::move(nodes);
  if (!frame.lines.empty()) line["log"] = watch_json(frame.lines);
  if (frame.lines_left_out > 0) line["log_left_out"] = frame.lines_left_out;
  if (!frame.times.empty()) line["times"] = watch_json(frame.times);
  if (!frame.past.empty()) line["past"] = frame.past;
  if (!frame.driven.empty()) {
    line["driven"] = Json::array();
    for (const Point& point : frame.driven) line["driven"].push_back(watch_json(point));
  }
  return watch_line(line);
}

std::string WatchText::alive_line(const RunStatus& status) {
  return watch_line({{"alive", true}, {"status", json_of(status)}});
}

std::string WatchText::end_line(const RunStatus& status) {
  return watch_line({{"ended", true}, {"status", json_of(status)}});
}

}  // namespace cairn
