#include "framework/reporting/report.hpp"

namespace cairn {

TruthScore score_against(const World& world, const LandmarkGraph& graph, double tolerance_m) {
  TruthScore score;
  std::vector<bool> found(world.objects.size(), false);
  for (const auto& [id, landmark] : graph.landmarks()) {
    if (landmark.marker) continue;
    std::size_t best = world.objects.size();
    double best_error = tolerance_m;
    for (std::size_t i = 0; i < world.objects.size(); ++i) {
      const WorldObject& object = world.objects[i];
      if (found[i] || object.category.empty() || object.category != landmark.category) continue;
      const double error = (object.T_map_object.position() - landmark.T_map_landmark.position()).norm();
      if (error > best_error) continue;
      best = i;
      best_error = error;
    }
    if (best == world.objects.size()) {
      ++score.false_landmarks;
      continue;
    }
    found[best] = true;
    score.matched.push_back({id, best_error});
  }
  for (std::size_t i = 0; i < world.objects.size(); ++i)
    if (!world.objects[i].category.empty() && !found[i]) ++score.missed_objects;
  return score;
}

}  // namespace cairn
