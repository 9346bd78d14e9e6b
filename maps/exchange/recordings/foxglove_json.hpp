// Foxglove's well-known messages as JSON, of what lies in the plane.
//
// JSON has no number for "no echo": a range that is not finite is written as 0. Times before 0 are written as 0.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn::exchange::foxglove {

enum class LogLevel { debug = 1, info = 2, warning = 3, error = 4 };

[[nodiscard]] std::string frame_transform(std::uint64_t time_ns, std::string_view parent, std::string_view child,
                                          const Pose2& T_parent_child);
[[nodiscard]] std::string pose_in_frame(std::uint64_t time_ns, std::string_view frame, const Pose2& T_frame_object);
[[nodiscard]] std::string poses_in_frame(std::uint64_t time_ns, std::string_view frame, std::span<const Pose2> poses);
[[nodiscard]] std::string log(std::uint64_t time_ns, LogLevel level, std::string_view name, std::string_view message);

struct Scan {
  Pose2 T_frame_laser;
  double first_rad = 0.0;  // of the beams, evenly spaced
  double last_rad = 0.0;
  std::vector<double> ranges_m;
};
[[nodiscard]] std::string laser_scan(std::uint64_t time_ns, std::string_view frame, const Scan& scan);

// Rows from the lowest y on, one byte a cell: the occupancy OL, 127 unknown (field "occupancy").
struct GridBytes {
  Point origin_m{0.0, 0.0};
  double cell_m = 0.0;
  int columns = 0;
  std::vector<std::uint8_t> ol;
};
// By the greater occupancy, until no side has more than max_side cells.
[[nodiscard]] GridBytes halved_to(int max_side, GridBytes bytes);
// What was seen of the grid, halved_to(max_side).
[[nodiscard]] GridBytes grid_bytes(const OccupancyGrid& grid, int max_side);
[[nodiscard]] std::string grid(std::uint64_t time_ns, std::string_view frame, const GridBytes& grid);

// A cylinder and a text with the landmark's name; its category and degree as metadata.
[[nodiscard]] std::string landmark(std::uint64_t time_ns, std::string_view frame, const Landmark& landmark);
[[nodiscard]] std::string no_landmark(std::uint64_t time_ns, LandmarkId id);

}  // namespace cairn::exchange::foxglove
