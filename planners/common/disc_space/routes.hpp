// Routes as corner points: shortened, measured, re-checked, and turned into poses.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "maps/geometry/segments.hpp"
#include "planners/common/disc_space/places.hpp"

namespace cairn {

// A point of a route, and which part of the route the straight segment that ends there belongs to.
struct PartedPoint {
  Point at{0.0, 0.0};
  int part = 0;
};
inline constexpr int kSeveralParts = -1;  // the segment cuts across

// How a route is shortened.
struct ShortcutRules {
  std::function<bool(const Point& from, const Point& to)> fits_along;
  double cell_m = 0.05;
  double max_shortcut_m = std::numeric_limits<double>::infinity();  // longer ones are not tried
  double max_work_cells = 1e5;                                      // of segments checked by tightened(), end to end
};
[[nodiscard]] ShortcutRules shortcuts_on(const DiscSpace& space, double radius_m);

// Drops the corners that a straight free segment can skip; the first `keep` points and the last stay. Looks from each
// corner to all others; those that the budget leaves no time for stay.
[[nodiscard]] std::vector<Point> straightened(const DiscSpace& space, const std::vector<Point>& route, double radius_m,
                                              std::size_t keep = 1, const Budget& budget = {});

// Cuts the corners that cannot be skipped whole as far as straight free segments allow, so that a route round something
// comes near to its tangents and arcs. For routes that are straightened; corners with ever smaller gains are left.
// Never longer; a segment of the answer fits where those of the route do. The first `keep` points and the last stay.
// Bounded work: the last corners of a route of many thousand cells may stay as they are, and those that the budget
// leaves no time for.
[[nodiscard]] std::vector<Point> tightened(const DiscSpace& space, const std::vector<Point>& route, double radius_m,
                                           std::size_t keep = 1, const Budget& budget = {});

// The same for routes of several parts: what lies across two of them gets kSeveralParts.
[[nodiscard]] std::vector<PartedPoint> straightened(const ShortcutRules& rules, const std::vector<PartedPoint>& route,
                                                    std::size_t keep = 1, const Budget& budget = {});
[[nodiscard]] std::vector<PartedPoint> tightened(const ShortcutRules& rules, const std::vector<PartedPoint>& route,
                                                 std::size_t keep = 1, const Budget& budget = {});
[[nodiscard]] std::vector<PartedPoint> straightened(const DiscSpace& space, const std::vector<PartedPoint>& route,
                                                    double radius_m, std::size_t keep = 1, const Budget& budget = {});
[[nodiscard]] std::vector<PartedPoint> tightened(const DiscSpace& space, const std::vector<PartedPoint>& route,
                                                 double radius_m, std::size_t keep = 1, const Budget& budget = {});
[[nodiscard]] std::vector<Point> points_of(const std::vector<PartedPoint>& route);

// The independent re-check, straight from the grid: with an escape the first segment is that escape.
[[nodiscard]] bool route_is_free(const OccupancyGrid& grid, const GroundRules& rules, const std::vector<Point>& route,
                                 double radius_m, const std::optional<Escape>& escape = std::nullopt);

// Least distance of the disc's edge to anything blocked, not below 0.
[[nodiscard]] double clearance_along(const DiscSpace& space, const std::vector<Point>& route, double radius_m);

// Headings along the segments; the last pose has the goal's heading if that is given, and a route of one
// point keeps `first_heading_rad`.
[[nodiscard]] std::vector<Pose2> poses_along(const std::vector<Point>& route, double first_heading_rad,
                                             std::optional<double> goal_heading_rad);

}  // namespace cairn
