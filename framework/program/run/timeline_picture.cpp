#include "framework/program/run/timeline_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace cairn {
namespace {

BarKind kind_of(RunEnd end) {
  return end == RunEnd::halted ? BarKind::halted : end == RunEnd::success ? BarKind::success : BarKind::failure;
}

std::size_t depth_of(const NodeReport& node) {
  return static_cast<std::size_t>(std::count(node.path.begin(), node.path.end(), '/'));
}

std::string label_of(const NodeReport& node) {
  return node.path + "  " + (node.name == node.kind ? node.kind : node.name + " (" + node.kind + ")");
}

// The deepest level at which the rows still fit.
std::size_t deepest_shown(const std::vector<NodeReport>& nodes, std::size_t max_rows) {
  std::map<std::size_t, std::size_t> count;
  for (const NodeReport& node : nodes) ++count[depth_of(node)];
  std::size_t rows = 0;
  std::size_t deepest = 0;
  for (const auto& [depth, of_depth] : count) {
    rows += of_depth;
    if (rows > max_rows) break;
    deepest = depth;
  }
  return deepest;
}

std::vector<TimelineRow> rows_of(const MissionResult& result, std::size_t deepest) {
  std::vector<TimelineRow> rows;
  std::map<std::string, std::size_t> row_of;
  for (const NodeReport& node : result.nodes) {
    if (depth_of(node) > deepest || rows.size() >= kMaxTimelineRows) continue;
    row_of[node.path] = rows.size();
    rows.push_back({label_of(node), depth_of(node), {}});
  }
  for (const NodeRun& run : result.node_runs.runs())
    if (const auto row = row_of.find(run.path); row != row_of.end())
      rows[row->second].bars.push_back({run.begin_s, run.end_s, kind_of(run.end)});
  return rows;
}

void add_marks(const RunTimeline& beside, Timeline& timeline) {
  TimelineMarks pauses{"paused", MarkKind::pause, {}};
  for (const PauseSpan& pause : beside.pauses())
    pauses.marks.push_back({pause.time_s, pause.time_s, fmt::format("{:.1f} s", pause.for_s)});
  TimelineMarks stops{"slowed down", MarkKind::stop, {}};
  for (const RunSpan& stop : beside.stops()) stops.marks.push_back({stop.begin_s, stop.end_s, ""});
  TimelineMarks holds{"held by the robot", MarkKind::stop, {}};
  for (const RunSpan& hold : beside.holds()) holds.marks.push_back({hold.begin_s, hold.end_s, ""});
  TimelineMarks bumps{"bumped", MarkKind::bump, {}};
  for (const double time_s : beside.bumps_s()) bumps.marks.push_back({time_s, time_s, ""});
  TimelineMarks saves{"map saved", MarkKind::save, {}};
  for (const double time_s : beside.saves_s()) saves.marks.push_back({time_s, time_s, ""});
  for (TimelineMarks* marks : {&pauses, &stops, &holds, &bumps, &saves})
    if (!marks->marks.empty()) timeline.marks.push_back(std::move(*marks));
}

}  // namespace

Timeline timeline_of(const Mission& mission, const MissionResult& result, const RunTimeline& beside) {
  Timeline timeline;
  timeline.title = mission.config.mission + ", seed " + std::to_string(mission.config.seed);
  timeline.begin_s = result.resumed_s.value_or(0.0);
  timeline.end_s = result.time_s;
  const std::size_t deepest = deepest_shown(result.nodes, kMaxTimelineRows);
  timeline.rows = rows_of(result, deepest);
  timeline.subtitle = fmt::format("{} after {:.1f} s of the mission's clock", name_of(result.outcome), result.time_s);
  if (timeline.rows.size() < result.nodes.size())
    timeline.subtitle += fmt::format("; {} of {} nodes that ran", timeline.rows.size(), result.nodes.size());
  if (result.node_runs.left_out() > 0)
    timeline.subtitle += fmt::format("; the last {} runs of nodes are left out", result.node_runs.left_out());
  add_marks(beside, timeline);
  return timeline;
}

}  // namespace cairn
