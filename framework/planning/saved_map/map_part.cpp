#include "framework/planning/saved_map/map_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cairn {
namespace {

std::optional<Point> point_of(const Place& place, const LandmarkGraph& graph) {
  if (place.pose) return place.pose->position().allFinite() ? std::optional(place.pose->position()) : std::nullopt;
  if (place.landmarks.size() != 1) return std::nullopt;
  const Landmark* const landmark = graph.find(place.landmarks.front());
  if (landmark == nullptr) return std::nullopt;
  return landmark->approach_pose().position();
}

// By way of a line x = at (or y = at): the shortest is the straight one to the mirrored end.
double by_way_of_m(double from_across, double to_across, double along) {
  return std::hypot(from_across + to_across, along);
}

}  // namespace

std::optional<MapEnds> ends_of(const PlanRequest& request, const LandmarkGraph& graph) {
  const auto from = point_of(request.from, graph);
  const auto to = point_of(request.to, graph);
  return from && to ? std::optional(MapEnds{*from, *to}) : std::nullopt;
}

bool costs_are_lengths(const LandmarkGraph& graph) {
  constexpr double kRounding = 1.0 - 1e-9;
  // In one piece of memory: a large graph is looked through for a single answer.
  std::vector<std::pair<LandmarkId, Point>> stands;
  stands.reserve(graph.landmarks().size());
  for (const auto& [id, landmark] : graph.landmarks()) stands.emplace_back(id, landmark.approach_pose().position());
  const auto stand = [&](LandmarkId id) -> const Point& {
    return std::lower_bound(stands.begin(), stands.end(), id,
                            [](const auto& at, LandmarkId of) { return at.first < of; })
        ->second;
  };
  return std::all_of(graph.routes().begin(), graph.routes().end(), [&](const auto& entry) {
    const Route& route = entry.second;
    const Point& from = stand(route.from);
    const Point& to = stand(route.to);
    const auto by_way_of = [&](const Pose2& pose) {
      return (pose.position() - from).norm() + (to - pose.position()).norm();
    };
    return route.cost_m >= kRounding * (to - from).norm() &&
           std::all_of(route.trajectory.begin(), route.trajectory.end(),
                       [&](const Pose2& pose) { return route.cost_m >= kRounding * by_way_of(pose) - kMaxRounding_m; });
  });
}

CellBox part_for(const MapEnds& ends, double length_m, double around_m, const OccupancyGrid& lattice,
                 const CellBox& whole) {
  // The ellipse with the ends as its foci.
  const Point half = 0.5 * (ends.to - ends.from);
  const double longer_m = 0.5 * std::max(length_m, 2.0 * half.norm());
  const double shorter_m = std::sqrt(std::max(0.0, longer_m * longer_m - half.squaredNorm()));
  const Point along = half.norm() > 0.0 ? Point(half.normalized()) : Point(1.0, 0.0);
  const Point reach(std::hypot(longer_m * along.x(), shorter_m * along.y()) + around_m,
                    std::hypot(longer_m * along.y(), shorter_m * along.x()) + around_m);
  const Point middle = ends.from + half;
  const CellBox box{lattice.cell_at(middle - reach), lattice.cell_at(middle + reach) + Cell{1, 1}};
  return intersected(box, whole);
}

double min_outside_m(const MapEnds& ends, const CellBox& part, double around_m, const OccupancyGrid& lattice,
                     const CellBox& whole) {
  const Point low = lattice.origin_m() + lattice.cell_m() * Point(part.min.x, part.min.y);
  const Point high = lattice.origin_m() + lattice.cell_m() * Point(part.max.x, part.max.y);
  double min_m = std::numeric_limits<double>::infinity();
  for (const int axis : {0, 1}) {
    const double along_m = ends.to[1 - axis] - ends.from[1 - axis];
    const auto by = [&](bool open, double a_m, double b_m) {
      if (!open) return;
      const double off_a_m = a_m - around_m;
      const double off_b_m = b_m - around_m;
      const bool inside = off_a_m > 0.0 && off_b_m > 0.0;
      min_m = std::min(min_m, inside ? by_way_of_m(off_a_m, off_b_m, along_m) : 0.0);
    };
    const auto coordinate = [axis](Cell cell) { return axis == 0 ? cell.x : cell.y; };
    by(coordinate(part.min) > coordinate(whole.min), ends.from[axis] - low[axis], ends.to[axis] - low[axis]);
    by(coordinate(part.max) < coordinate(whole.max), high[axis] - ends.from[axis], high[axis] - ends.to[axis]);
  }
  return min_m;
}

}  // namespace cairn
