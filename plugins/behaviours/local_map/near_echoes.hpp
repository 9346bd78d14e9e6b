// What has echoed from near is solid, what echoes have passed through from near is free.
//
// Smooth walls bounce a slanting beam away, and the long reading that comes instead wipes them out of an
// occupancy grid; the width of a beam draws arcs beside everything that is seen from afar. Near echoes along
// the middle of a beam are the trustworthy part of a sonar, and better still is where the robot has stood:
// both outvote the map. Only echoes count here, never silence.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/observation.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn::behaviours {

inline constexpr int kMaxSensors = 4096;  // an index beyond it is an error of the source, not a transducer
inline constexpr double kFree = 0.1;      // probability of what is taken to be free; of what is occupied: 1 - kFree

struct NearEchoSettings {
  double within_m = 1.0;
  double moved_m = 0.02;
  double turned_rad = radians(3.0);
  int rays = 5;
  int hit = 100;
  int passed = -50;
  int solid_at = 160;
  int free_at = -280;
  int stood = -400;
  double clamp_nat = 1.6;
  static void describe(Fields<NearEchoSettings>& fields);
};

// on_cone(reading) for what has a width, on_rays(span) for rays that follow each other from one place of the robot and
// have numbers.
template <class OnCone, class OnRays>
void for_each_scan(std::span<const RangeReading> all, const OnCone& on_cone, const OnRays& on_rays) {
  const auto is_ray = [](const RangeReading& reading) {
    return reading.half_beam_rad == 0.0 && reading.sensor >= 0 && reading.sensor < kMaxSensors &&
           std::isfinite(reading.min_m);
  };
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first + 1;
    if (is_ray(all[first])) {
      const Point from = all[first].T_robot_sensor.position();
      while (end < all.size() && is_ray(all[end]) && all[end].T_robot_sensor.position() == from) ++end;
      on_rays(all.subspan(first, end - first));
    } else {
      on_cone(all[first]);
    }
    first = end;
  }
}

class NearEchoes {
 public:
  // Cells as those of the map.
  explicit NearEchoes(const OccupancyGrid& map, const NearEchoSettings& settings = {});

  // A reading counts when its transducer has moved since the last one that did.
  void see(const Observation& observation, const Pose2& T_map_robot);
  // For while the robot faces an opening: echoes from farther away count too, for what they have passed up to so far.
  void see_through(const Observation& observation, const Pose2& T_map_robot, double to_m);
  // Where the robot stands is free.
  void stand_at(const Point& p_map, double radius_m);

  [[nodiscard]] bool is_solid(Cell cell) const;
  [[nodiscard]] bool is_conservatively_free(Cell cell) const;
  // What the map says where the votes do not know better.
  [[nodiscard]] bool is_occupied(const OccupancyGrid& map, Cell cell) const {
    return is_solid(cell) || (map.state(cell) == CellState::occupied && !is_conservatively_free(cell));
  }
  // What the echoes say about each cell: less than 0: more have passed it than came from it.
  [[nodiscard]] const OccupancyGrid& votes() const { return votes_; }
  // A copy of this part of the map with the votes applied.
  [[nodiscard]] OccupancyGrid applied_to(const OccupancyGrid& map, const CellBox& part) const;

 private:
  void vote(const RangeReading& reading, const Pose2& T_map_sensor);
  // Rays from one place vote together: once for each cell, and an echo outvotes what others have passed.
  void vote(std::span<const RangeReading> rays, const Pose2& T_map_robot);
  void vote_through(std::span<const RangeReading> rays, const Pose2& T_map_robot, double to_m);
  [[nodiscard]] bool is_far_echo(const RangeReading& reading, double to_m) const;
  // Where such rays pass, those that lie closer together than cells taken for the shortest of them.
  void pass(std::span<const RangeReading> rays, const Pose2& T_map_robot, double longest_m, double short_of_m,
            std::vector<Cell>& cells) const;

  [[nodiscard]] bool counts_anew(const RangeReading& reading, const Pose2& T_map_sensor);
  [[nodiscard]] bool is_usable(const RangeReading& reading) const;
  [[nodiscard]] std::vector<Cell> passed_by(const RangeReading& reading, const Pose2& T_map_sensor, double to_m) const;
  [[nodiscard]] bool has_moved(const Pose2& a, const Pose2& b) const;

  NearEchoSettings settings_;
  OccupancyGrid votes_;
  std::vector<Pose2> last_voted_;  // T_map_sensor, by transducer
};

}  // namespace cairn::behaviours
