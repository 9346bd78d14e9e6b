// Where a disc fits near a point, how it leaves a tight start, and why it does not fit.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "framework/contracts/path_planner.hpp"
#include "planners/common/disc_space/disc_space.hpp"

namespace cairn {

// How far from a landmark without an access its approach pose may be.
inline constexpr double kApproachNear_m = 1.5;

// The cell centre nearest to a point, within a distance, where the disc fits and `accept` (optional)
// agrees. Ties go to the smaller (y, x).
[[nodiscard]] std::optional<Point> nearest_fit(const DiscSpace& space, const Point& near_map, double radius_m,
                                               double within_m, const std::function<bool(const Point&)>& accept = {});

// The pose of a robot that is at a landmark: its access where the disc fits, else the nearest place that
// fits (and that `accept` agrees to) round the access or, without one, round the landmark. The heading
// of another place than the access is towards the landmark.
[[nodiscard]] std::optional<Pose2> approach_pose(const DiscSpace& space, const Landmark& landmark, double radius_m,
                                                 const std::function<bool(const Point&)>& accept = {});

// Why the disc does not fit there, as the end of a sentence: "an occupied cell is 0.12 m from its centre".
[[nodiscard]] std::string why_blocked(const OccupancyGrid& grid, const DiscSpace& space, const Point& p_map,
                                      double radius_m);
// "; the nearest free place is (1.200, 0.850), 0.25 m away", or that there is none; `accept` as in nearest_fit.
[[nodiscard]] std::string nearest_free_text(const DiscSpace& space, const Point& p_map, double radius_m,
                                            const std::function<bool(const Point&)>& accept = {});
[[nodiscard]] std::string text_of(const Point& p_map);
[[nodiscard]] std::string metres_text(double value_m);  // "0.25 m"

// True when the robot itself is there now: its own body shows that the cells under it are free.
[[nodiscard]] bool robot_stands_at(const WorldView& world, const Point& p_map);
// The grid with the unknown cells under the disc made free, or none when there are no such cells.
[[nodiscard]] std::optional<OccupancyGrid> with_ground_under(const OccupancyGrid& grid, const GroundRules& rules,
                                                             const Point& p_map, double radius_m);
// The same under a robot of any form, none of which is further than reach_m from the point.
[[nodiscard]] std::optional<OccupancyGrid> with_ground_under(const OccupancyGrid& grid, const GroundRules& rules,
                                                             const Point& p_map, double reach_m,
                                                             const std::function<bool(Cell)>& covers);

// A straight escape path out of a start that is too near to something. On it the disc keeps keep_m, which is
// what the start itself keeps from occupied cells, and may cross unknown ones.
struct Escape {
  Point to;
  double keep_m = 0.0;
};
// The nearest place that fits within tolerance_m; none when the start is on an occupied cell.
[[nodiscard]] std::optional<Escape> escape_from(const OccupancyGrid& grid, const DiscSpace& space, const Point& start,
                                                double radius_m, double tolerance_m);
[[nodiscard]] bool escape_is_free(const OccupancyGrid& grid, const GroundRules& rules, const Point& start,
                                  const Escape& escape);

}  // namespace cairn
