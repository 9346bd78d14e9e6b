// What one who watches a running mission gets at once: values, none of which the mission still uses.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/behaviour_tree/runner.hpp"
#include "framework/mission/events.hpp"
#include "framework/mission/run_control.hpp"
#include "framework/modules/stage_clock.hpp"
#include "framework/reporting/grid_tiles.hpp"
#include "framework/reporting/last_ranges.hpp"
#include "maps/clustering/cluster_tree.hpp"

namespace cairn {

inline constexpr std::size_t kMaxFrameTiles = 256;      // of the grid; the rest comes with the next frames
inline constexpr std::size_t kMaxFrameLandmarks = 500;  // likewise
inline constexpr std::size_t kMaxFrameRanges = 720;     // of one observation, evenly chosen
inline constexpr std::size_t kMaxFramePath = 5000;      // points of the path driven so far
inline constexpr std::size_t kMaxWatchedLines = 500;    // that wait for those who watch; the oldest go

struct WatchLine {
  double time_s = 0.0;
  std::string sentence;
};

struct WatchPlan {
  double time_s = 0.0;
  PlanResult result;
};

struct WatchFrame {
  bool is_last = false;    // of the run: has no pose, ranges and status
  bool is_afresh = false;  // all that was sent of the map is to be forgotten: it is another one now
  std::int64_t tick = 0;   // ticks so far
  double time_s = 0.0;
  bool is_paused = false;
  PoseEstimate pose;
  Twist commanded{};
  std::optional<Pose2> truth{};
  std::vector<ShownRange> ranges{};  // of the last observation; of few transducers, the last of each
  double cell_m = 0.0;
  Point origin_m{0.0, 0.0};
  CellBox bounds;
  std::vector<GridTile> tiles{};  // changed since the last frame
  bool has_more = false;          // tiles or landmarks that did not fit in
  std::vector<Landmark> landmarks{};
  std::vector<LandmarkId> retired{};
  std::shared_ptr<const std::vector<Route>> routes{};            // null: as before
  std::shared_ptr<const std::vector<ListedCluster>> clusters{};  // null: as before
  std::shared_ptr<const WatchPlan> plan{};                       // the last one, while it is under way
  std::vector<NodeReport> nodes{};                               // that were ticked
  std::vector<WatchLine> lines{};                                // since the last frame
  std::uint64_t lines_left_out = 0;                              // before these
  std::vector<Point> driven{};                                   // of the first frame
  std::vector<std::string> past{};    // of the first frame: sentences so far, each behind its time
  std::vector<StageTime> times{};     // so far, of the wall clock: once a second of the mission
  std::optional<RunStatus> status{};  // when it was asked for
};

}  // namespace cairn
