// Where the robot was when, which plan it had, when landmarks came and went and how the grid grew: for the timeline of
// a finished run.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/mission/events.hpp"
#include "framework/mission/history.hpp"
#include "framework/reporting/grid_history.hpp"
#include "framework/reporting/last_ranges.hpp"
#include "framework/reporting/thinned_series.hpp"

namespace cairn {

class RunTrack final : public Listener {
 public:
  // history: bounds its size.
  explicit RunTrack(const HistoryConfig& history = {});

  void on(const Event& event, const MissionView& view) override;

  // {"robot_radius_m", "poses_every": ticks, "poses": [[time_s, x_m, y_m, theta_rad, xx, xy, yy]], "plans": [{time_s,
  // points}], "landmarks": [{time_s, id, change}], "grid": [{time_s, tiles: [[x, y, ol]]}], "ranges": [[time_s, [x_m,
  // y_m, theta_rad, half_beam_rad, range_m], ...]]}. xx, xy, yy: the covariance in m^2; a range without an echo is
  // negative. change: found or retired; ol: base 64 of the tile's cells (GridTile), packed by zlib. The same bytes for
  // the same build, mission and seed.
  [[nodiscard]] std::string json() const;

 private:
  struct Sample {
    double time_s = 0.0;
    Pose2 T_map_robot;
    std::array<double, 3> covariance_m2{};  // xx, xy, yy
  };
  struct Readings {
    double time_s = 0.0;
    std::vector<ShownRange> ranges;
  };
  void note_ranges(const WorldView& world);
  struct Plan {
    double time_s = 0.0;
    std::vector<Point> points{};  // empty: the plan is over
    bool is_from_planner = false;
  };
  struct Change {
    double time_s = 0.0;
    LandmarkId id = 0;
    bool is_retired = false;
  };
  void note_plan(Plan plan);

  const std::size_t max_events_;
  double robot_radius_m_ = 0.0;
  ThinnedSeries<Sample> poses_;
  LastRanges last_ranges_;
  ThinnedSeries<Readings> ranges_;
  std::vector<Plan> plans_;
  std::size_t plan_points_ = 0;
  std::vector<Change> landmarks_;
  GridHistory grid_;
};

}  // namespace cairn
