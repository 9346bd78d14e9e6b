// What is near the robot now, as points: the map's occupied cells that no live echo has passed through, and the last
// echo of each transducer.
#pragma once

#include <span>
#include <vector>

#include "framework/contracts/world_view.hpp"
#include "maps/geometry/bearing_maxima.hpp"
#include "plugins/behaviours/local_map/cell_layer.hpp"
#include "plugins/behaviours/local_map/near_echoes.hpp"

namespace cairn::behaviours {

struct LocalObstacleSettings {
  double within_m = 1.3;
  double map_every_s = 0.2;
  double echo_counts_s = 0.7;
  double behind_m = 0.15;
  double explained_m = 0.1;
  double sure_beam_ratio = 0.6;
  double min_beam_rad = radians(1.0);
  int arc_points = 5;
  static void describe(Fields<LocalObstacleSettings>& fields);
};

class LocalObstacles {
 public:
  explicit LocalObstacles(const LocalObstacleSettings& settings = {}) : settings_(settings) {}

  // Every tick. Of the map: what the grid, as corrected by near echoes, holds occupied, but for ignored cells and those
  // that a live echo has passed through. Of each transducer: its last echo, on its whole arc unless something known
  // explains it.
  void see(const WorldView& world, const NearEchoes& near_echoes, const CellSet& ignored = {});
  // All of it has its place in another map.
  void forget() { *this = LocalObstacles(settings_); }
  // In the robot frame, as of the last see().
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }

  // What the live echoes (not silence) say about a place: something is there, nothing is, or neither.
  enum class Live { silent, there, seen_through };
  [[nodiscard]] Live live_echo_at(const Point& p_map, double time_s) const;

 private:
  struct Echo {
    double stamp_s = -1e9;
    double range_m = 0.0;  // +inf: none
    double half_beam_rad = 0.0;
    Pose2 T_map_sensor;
    std::vector<Point> points_map;
  };
  // The last scan of rays from one place of the robot.
  struct Scan {
    int first_sensor = 0;
    double stamp_s = -1e9;
    Point from_map{0.0, 0.0};
    BearingMaxima ranges_m;  // of its echoes, by bearing in the map
    std::vector<Point> points_map;
  };
  void add_scan(std::span<const RangeReading> rays, const WorldView& world);
  [[nodiscard]] bool is_explained(const Echo& echo, const std::vector<Point>& there_map) const;
  void gather_cells(const WorldView& world, const NearEchoes& near_echoes, const CellSet& ignored);
  void add(const RangeReading& reading, const WorldView& world);

  LocalObstacleSettings settings_;
  std::vector<Point> cells_map_;
  double gathered_s_ = -1e9;
  std::vector<Echo> echoes_;  // by transducer
  std::vector<Scan> scans_;
  std::vector<Point> points_;
};

}  // namespace cairn::behaviours
