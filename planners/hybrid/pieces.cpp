#include "planners/hybrid/pieces.hpp"

namespace cairn {

std::vector<PlanPiece> pieces_of(const std::vector<PartedPoint>& route, const std::vector<PlanPiece>& parts) {
  std::vector<PlanPiece> pieces;
  int last = kSeveralParts - 1;  // none
  for (std::size_t i = 1; i < route.size(); ++i) {
    const double length_m = (route[i].at - route[i - 1].at).norm();
    if (length_m == 0.0) continue;
    const int part = route[i].part;
    if (part != last)
      pieces.push_back(part == kSeveralParts ? PlanPiece{PlanPiece::Origin::cut, 0, 0.0}
                                             : parts.at(static_cast<std::size_t>(part)));
    last = part;
    pieces.back().length_m += length_m;
  }
  return pieces;
}

std::vector<PlanPiece> pieces_of_graph(const PlanResult& found, const LandmarkGraph& graph) {
  std::vector<PlanPiece> parts;
  std::vector<PartedPoint> route;
  const auto stand_at = [&](LandmarkId id) {
    const Landmark& landmark = *graph.find(id);
    return landmark.access.value_or(landmark.T_map_landmark).position();
  };
  for (std::size_t i = 0; i < found.routes.size(); ++i) {
    const Route& leg = *graph.find_route(found.routes[i]);
    const bool stored = !leg.trajectory.empty();
    if (route.empty() && !stored) route.push_back({stand_at(found.landmarks[i]), 0});
    parts.push_back({stored ? PlanPiece::Origin::stored : PlanPiece::Origin::straight, leg.id, 0.0});
    const int part = static_cast<int>(i);
    for (const Pose2& pose : leg.trajectory) route.push_back({pose.position(), part});
    if (!stored) route.push_back({stand_at(found.landmarks[i + 1]), part});
  }
  return pieces_of(route, parts);
}

}  // namespace cairn
