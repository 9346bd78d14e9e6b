#include "planners/hybrid/segments.hpp"

namespace cairn {

std::vector<PathSegment> segments_of(const std::vector<PartedPoint>& route, const std::vector<PathSegment>& parts) {
  std::vector<PathSegment> segments;
  int last = kSeveralParts - 1;  // none
  for (std::size_t i = 1; i < route.size(); ++i) {
    const double length_m = (route[i].at - route[i - 1].at).norm();
    if (length_m == 0.0) continue;
    const int part = route[i].part;
    if (part != last)
      segments.push_back(part == kSeveralParts ? PathSegment{PathSegment::Origin::cut, 0, 0.0}
                                               : parts.at(static_cast<std::size_t>(part)));
    last = part;
    segments.back().length_m += length_m;
  }
  return segments;
}

std::vector<PathSegment> segments_of_graph(const PlanResult& found, const LandmarkGraph& graph) {
  std::vector<PathSegment> parts;
  std::vector<PartedPoint> route;
  const auto approach_to = [&](LandmarkId id) {
    const Landmark& landmark = *graph.find(id);
    return landmark.approach_pose().position();
  };
  for (std::size_t i = 0; i < found.routes.size(); ++i) {
    const Route& leg = *graph.find_route(found.routes[i]);
    const bool stored = !leg.trajectory.empty();
    if (route.empty() && !stored) route.push_back({approach_to(found.landmarks[i]), 0});
    parts.push_back({stored ? PathSegment::Origin::stored : PathSegment::Origin::straight, leg.id, 0.0});
    const int part = static_cast<int>(i);
    for (const Pose2& pose : leg.trajectory) route.push_back({pose.position(), part});
    if (!stored) route.push_back({approach_to(found.landmarks[i + 1]), part});
  }
  return segments_of(route, parts);
}

}  // namespace cairn
