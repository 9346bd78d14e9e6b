#include "framework/reporting/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/reporting/event_sentences.hpp"
#include "framework/reporting/localisation_json.hpp"
#include "maps/landmarks/close_categories.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

// A sentence may quote a file that is not text.
constexpr auto kBadText = ordered_json::error_handler_t::replace;

// Figures are for people and scripts: micrometres and micro-degrees are enough.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6;
}

ordered_json json_of(const Landmark& landmark) {
  ordered_json templates = ordered_json::array();
  for (const TemplateDegree& t : landmark.templates)
    templates.push_back(
        {{"category", t.category}, {"angle_deg", rounded(degrees(t.orientation_rad))}, {"degree", rounded(t.degree)}});
  ordered_json evidence = ordered_json::object();
  for (const CategoryEvidence& e : landmark.evidence)
    evidence[e.category] = {{"matchings", e.matchings},
                            {"mean_degree", rounded(e.mean_degree)},
                            {"best_degree", rounded(e.best_degree)},
                            {"last_degree", rounded(e.last_degree)}};
  ordered_json described = {{"id", "L" + std::to_string(landmark.id)},
                            {"category", landmark.category},
                            {"x_m", rounded(landmark.T_map_landmark.x_m)},
                            {"y_m", rounded(landmark.T_map_landmark.y_m)},
                            {"angle_deg", rounded(degrees(landmark.T_map_landmark.theta_rad))},
                            {"degree", rounded(landmark.degree)},
                            {"sightings", landmark.sightings},
                            {"templates", templates},
                            {"evidence", evidence}};
  if (!landmark.name.empty()) described["name"] = landmark.name;
  if (landmark.marker) described["marker"] = text_of(*landmark.marker);
  if (const auto close = close_categories(landmark))
    described["close_to"] = {
        {"category", close->other}, {"degree", rounded(close->other_degree)}, {"own_degree", rounded(close->degree)}};
  return described;
}

ordered_json json_of(const LandmarkGraph& graph) {
  ordered_json landmarks = ordered_json::array();
  for (const auto& [id, landmark] : graph.landmarks()) landmarks.push_back(json_of(landmark));
  return landmarks;
}

ordered_json json_of(const std::vector<StepReport>& steps) {
  ordered_json list = ordered_json::array();
  for (const StepReport& step : steps)
    list.push_back({{"step", step.name},
                    {"outcome", step.status.state == StepState::success ? "success" : "failure"},
                    {"reason", step.status.reason},
                    {"begin_s", rounded(step.begin_s)},
                    {"end_s", rounded(step.end_s)}});
  return list;
}

ordered_json json_of(const std::vector<NodeReport>& nodes) {
  const auto outcome_of = [](const NodeReport& node) {
    if (node.is_halted) return "halted";
    return node.status.state == StepState::success ? "success" : "failure";
  };
  ordered_json list = ordered_json::array();
  for (const NodeReport& node : nodes)
    list.push_back({{"path", node.path},
                    {"kind", node.kind},
                    {"name", node.name},
                    {"outcome", outcome_of(node)},
                    {"reason", node.status.reason},
                    {"begin_s", rounded(node.begin_s)},
                    {"end_s", rounded(node.end_s)},
                    {"ticks", node.ticks},
                    {"runs", node.runs}});
  return list;
}

ordered_json json_of(const std::vector<NodeRun>& runs) {
  ordered_json list = ordered_json::array();
  for (const NodeRun& run : runs)
    list.push_back({{"path", run.path},
                    {"begin_s", rounded(run.begin_s)},
                    {"end_s", rounded(run.end_s)},
                    {"outcome", std::string(name_of(run.end))},
                    {"runs", run.runs}});
  return list;
}

void add_timeline(ordered_json& report, const RunTimeline& timeline) {
  report["pauses"] = report["stops"] = report["holds"] = ordered_json::array();
  for (const PauseSpan& pause : timeline.pauses())
    report["pauses"].push_back({{"time_s", rounded(pause.time_s)}, {"for_s", rounded(pause.for_s)}});
  for (const RunSpan& stop : timeline.stops())
    report["stops"].push_back({{"begin_s", rounded(stop.begin_s)}, {"end_s", rounded(stop.end_s)}});
  for (const RunSpan& hold : timeline.holds())
    report["holds"].push_back({{"begin_s", rounded(hold.begin_s)}, {"end_s", rounded(hold.end_s)}});
}

ordered_json json_of(const std::vector<StageTime>& times) {
  ordered_json list = ordered_json::array();
  for (const StageTime& t : times)
    list.push_back({{"stage", t.stage},
                    {"module", t.module},
                    {"count", t.count},
                    {"median_us", rounded(t.median_us)},
                    {"p99_us", rounded(t.p99_us)},
                    {"worst_us", rounded(t.worst_us)},
                    {"total_s", rounded(t.total_s)},
                    {"own_s", rounded(t.own_s)}});
  return list;
}

ordered_json json_of(const AutosaveFigures& autosave) {
  return {{"saved", autosave.saved},
          {"failed", autosave.failed},
          {"reason", autosave.failure},
          {"in_loop_s", rounded(autosave.in_loop_s)},
          {"writing_s", rounded(autosave.writing_s)},
          {"written_bytes", autosave.written_bytes}};
}

ordered_json json_of(const CollisionMonitorFigures& figures, const std::string& hearing) {
  return {{"slowed_s", rounded(figures.slowed_s)},
          {"stopped_s", rounded(figures.stopped_s)},
          {"stale_s", rounded(figures.stale_s)},
          {"deaf_s", rounded(figures.deaf_s)},
          {"deaf", hearing}};
}

ordered_json json_of(const std::vector<TimedContact>& contacts) {
  ordered_json list = ordered_json::array();
  for (const TimedContact& touch : contacts)
    list.push_back({{"time_s", rounded(touch.time_s)},
                    {"speed_mps", rounded(touch.contact.speed_mps)},
                    {"could_be_seen", touch.contact.could_be_seen}});
  return list;
}

ordered_json json_of(const std::vector<ClusterLevel>& levels) {
  ordered_json list = ordered_json::array();
  for (const auto& [clusters, boundary] : levels) list.push_back({{"clusters", clusters}, {"boundary", boundary}});
  return list;
}

ordered_json main_figures(const Mission& mission, const MissionResult& result, const LandmarkGraph& graph,
                          const std::vector<TimedContact>& contacts) {
  return {{"mission", mission.config.mission},
          {"seed", mission.config.seed},
          {"outcome", std::string(name_of(result.outcome))},
          {"reason", result.reason},
          {"landmarks", json_of(graph)},
          {"routes", graph.routes().size()},
          {"levels", json_of(result.cluster_levels)},
          {"matchings", result.matchings},
          {"readings", result.readings},
          {"collisions", result.collisions},
          {"contacts", json_of(contacts)},
          {"collision_monitor", json_of(result.collision_monitor, result.hearing)},
          {"distance_m", rounded(result.distance_m)},
          {"time_s", rounded(result.time_s)}};
}

ordered_json json_of(const PoseErrorFigures& error) {
  return {{"median_m", rounded(error.median_m)},
          {"p95_m", rounded(error.p95_m)},
          {"worst_m", rounded(error.worst_m)},
          {"last_m", rounded(error.last_m)},
          {"median_deg", rounded(error.median_deg)},
          {"worst_deg", rounded(error.worst_deg)},
          {"sigmas_median", rounded(error.sigmas_median)},
          {"corrections", error.corrections},
          {"refused", error.refused}};
}

ordered_json json_of(const std::vector<PoseErrorSample>& samples) {
  ordered_json rows = ordered_json::array();
  for (const PoseErrorSample& sample : samples)
    rows.push_back({{"time_s", rounded(sample.time_s)},
                    {"error_m", rounded(sample.error_m)},
                    {"error_deg", rounded(degrees(sample.error_rad))}});
  return rows;
}

ordered_json json_of(const std::vector<NearMiss>& misses) {
  ordered_json list = ordered_json::array();
  for (const NearMiss& miss : misses) {
    ordered_json entry = {{"category", miss.category},
                          {"x_m", rounded(miss.at_m.x())},
                          {"y_m", rounded(miss.at_m.y())},
                          {"degree", rounded(miss.degree)},
                          {"time_s", rounded(miss.time_s)}};
    if (!miss.next_category.empty()) {
      entry["next_category"] = miss.next_category;
      entry["next_degree"] = rounded(miss.next_degree);
    }
    if (miss.needed) entry["needs"] = rounded(*miss.needed);
    list.push_back(std::move(entry));
  }
  return list;
}

std::string at_time(double time_s, const std::string& sentence) {
  return fmt::format("{:.2f} s: {}", time_s, sentence);
}

std::optional<Pose2> true_pose(const MissionView& view) {
  return view.truth ? std::optional(view.truth->T_map_robot) : std::nullopt;
}

// Only of a robot whose place was in doubt.
void add_watch(ordered_json& json, const WatchFigures& watch) {
  if (!watch.doubts.empty()) json["doubts"] = ordered_json::parse(doubts_json(watch));
  if (watch.doubts_left_out > 0) json["doubts_left_out"] = watch.doubts_left_out;
  if (!watch.carried.empty()) json["carried"] = ordered_json::parse(carried_json(watch));
}

void add_map_moves(ordered_json& json, const MissionResult& result) {
  if (result.pose_graph) json["pose_graph"] = ordered_json::parse(pose_graph_json(*result.pose_graph));
  if (result.map_moves > 0) json["map_moves"] = result.map_moves;
}

}  // namespace

RunReport::RunReport(const HistoryConfig& history)
    : max_contacts_(history.max_events),
      degrees_(history.max_samples),
      pose_errors_(history.max_samples),
      track_(history),
      events_(history.max_events) {}

void RunReport::on(const Event& event, const MissionView& view) {
  timeline_.on(event, view);
  track_.on(event, view);
  if (const auto* done = std::get_if<MatchingDone>(&event)) {
    const Matching& matching = done->matching;
    near_misses_.update(matching, view.world.time_s);
    degrees_.add({view.world.time_s, matching.region_centre_m, matching.degrees, matching.templates,
                  true_pose(view).value_or(view.world.pose.T_map_robot).position(), matching.fits_above});
  }
  if (std::holds_alternative<TickDone>(event)) {
    pose_errors_.note(view.world, true_pose(view));
    markers_.note(view.world);
  }
  if (std::holds_alternative<Bumped>(event)) note_contact(view);
  const std::string sentence = sentence_of(event);
  if (!sentence.empty()) events_.add(at_time(view.world.time_s, sentence));
}

void RunReport::note_contact(const MissionView& view) {
  if (contacts_.size() >= max_contacts_) return;
  if (view.truth && view.truth->contact) contacts_.push_back({view.world.time_s, *view.truth->contact});
}

std::string RunReport::report_json(const Mission& mission, const MissionResult& result, const LandmarkGraph& graph,
                                   const std::vector<std::string>& pictures) const {
  ordered_json report = main_figures(mission, result, graph, contacts_);
  report["retired"] = ordered_json::array();
  for (const auto& [id, retired] : graph.retired()) {
    ordered_json landmark = json_of(retired.landmark);
    landmark["reason"] = retired.reason;
    report["retired"].push_back(std::move(landmark));
  }
  report["near_misses"] = json_of(near_misses_.away_from(graph));
  report["explored_ratio"] = rounded(result.explored_ratio);
  if (result.resumed_s) report["resumed_s"] = rounded(*result.resumed_s);
  report["steps"] = json_of(result.steps);
  report["nodes"] = json_of(result.nodes);
  report["node_runs"] = json_of(result.node_runs.runs());
  report["node_runs_left_out"] = result.node_runs.left_out();
  add_timeline(report, timeline_);
  if (result.start_check) report["start_check"] = ordered_json::parse(start_check_json(*result.start_check));
  if (result.localisation) report["localisation"] = ordered_json::parse(localisation_json(*result.localisation));
  add_watch(report, result.watch);
  add_map_moves(report, result);
  report["map"] = result.map_file;
  report["pictures"] = pictures;
  if (const auto error = pose_errors_.figures()) report["pose_error"] = json_of(*error);
  if (markers_.sightings() > 0) report["markers"] = ordered_json::parse(markers_.json());
  ordered_json degrees = ordered_json::array();
  for (const DegreeSample& sample : degrees_.samples()) {
    ordered_json row = {{"time_s", rounded(sample.time_s)}};
    for (const CategoryDegree& d : sample.degrees) row[d.category] = rounded(d.degree);
    degrees.push_back(std::move(row));
  }
  report["degrees"] = degrees;
  report["pose_errors"] = json_of(pose_errors_.samples());
  if (degrees_.every() > 1) report["degrees_every"] = degrees_.every();
  report["events"] = events_.sentences();
  if (events_.left_out() > 0) report["events_left_out"] = events_.left_out();
  return report.dump(2, ' ', false, kBadText) + "\n";
}

std::string timing_json(const std::vector<StageTime>& times) {
  return json_of(times).dump(2);
}

std::string RunReport::summary_json(const Mission& mission, const MissionResult& result, const MissionRunner& runner,
                                    const std::filesystem::path& out, const std::vector<std::string>& pictures,
                                    double wall_s) const {
  ordered_json summary = main_figures(mission, result, runner.graph(), contacts_);
  summary["explored_ratio"] = rounded(result.explored_ratio);
  if (const auto error = pose_errors_.figures()) summary["pose_error"] = json_of(*error);
  if (markers_.sightings() > 0) summary["markers"] = ordered_json::parse(markers_.json());
  summary["wall_s"] = rounded(wall_s);
  if (result.start_check) summary["start_check"] = ordered_json::parse(start_check_json(*result.start_check));
  if (result.localisation) summary["localisation"] = ordered_json::parse(localisation_json(*result.localisation));
  add_watch(summary, result.watch);
  add_map_moves(summary, result);
  if (result.resumed_s) summary["resumed_s"] = rounded(*result.resumed_s);
  summary["autosave"] = json_of(result.autosave);
  summary["map"] = result.map_file.empty() ? "" : (out / result.map_file).string();
  const std::filesystem::path report = out / "report.json";
  summary["report"] = std::filesystem::exists(report) ? report.string() : "";
  ordered_json files = ordered_json::array();
  for (const std::string& picture : pictures) files.push_back((out / picture).string());
  summary["pictures"] = files;
  summary["timing"] = json_of(runner.times());
  return summary.dump(-1, ' ', false, kBadText);
}

}  // namespace cairn
