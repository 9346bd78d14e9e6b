#include "framework/experiments/recognition/recognition.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

// None for a shape that looks the same all round.
std::optional<double> orientation_error(const Mission& mission, const FoundThing& pair) {
  constexpr double kFineCell_m = 0.02;
  const double step_rad = mission.template_settings.step_rad;
  const auto shape = std::ranges::find(mission.shapes, pair.object->category, &LandmarkShape::category);
  const std::size_t distinct = distinct_orientations(shape->contour, step_rad, kFineCell_m).size();
  if (distinct == 1) return std::nullopt;
  const double period_rad = static_cast<double>(distinct) * step_rad;
  return std::abs(
      std::remainder(pair.landmark->T_map_landmark.theta_rad - pair.object->T_map_object.theta_rad, period_rad));
}

}  // namespace

std::vector<FoundThing> pairs_within(const World& world, const LandmarkGraph& graph, double tolerance_m) {
  std::vector<FoundThing> pairs;
  for (const auto& [id, landmark] : graph.landmarks())
    for (const WorldObject& object : world.objects) {
      const double distance_m = (object.T_map_object.position() - landmark.T_map_landmark.position()).norm();
      if (distance_m <= tolerance_m) pairs.push_back({distance_m, &landmark, &object});
    }
  std::ranges::stable_sort(pairs, {}, &FoundThing::distance_m);
  std::vector<FoundThing> taken;
  for (const FoundThing& pair : pairs)
    if (std::ranges::none_of(
            taken, [&](const FoundThing& t) { return t.landmark == pair.landmark || t.object == pair.object; }))
      taken.push_back(pair);
  return taken;
}

void FirstKnown::on(const Event& event, const MissionView& view) {
  if (std::holds_alternative<TickDone>(event)) {
    const Point here_m = view.world.pose.T_map_robot.position();
    if (last_m_) driven_m_ += (here_m - *last_m_).norm();
    last_m_ = here_m;
  }
  if (const auto* changed = std::get_if<LandmarkChanged>(&event))
    known_at_m_.try_emplace(changed->landmark.id, driven_m_);
}

double FirstKnown::driven_m(LandmarkId id) const {
  const auto found = known_at_m_.find(id);
  return found == known_at_m_.end() ? 0.0 : found->second;
}

std::vector<Verdict> judge_recognition(const Mission& mission, const LandmarkGraph& graph, const FirstKnown& known,
                                       double tolerance_m) {
  const std::vector<FoundThing> pairs = pairs_within(*mission.world, graph, tolerance_m);
  std::vector<Verdict> verdicts;
  for (const WorldObject& object : mission.world->objects) {
    const auto pair = std::ranges::find(pairs, &object, &FoundThing::object);
    Verdict& verdict = verdicts.emplace_back();
    verdict.is = object.category;
    if (pair == pairs.end()) continue;
    verdict.found = pair->landmark->category;
    verdict.position_error_m = pair->distance_m;
    verdict.driven_m = known.driven_m(pair->landmark->id);
    if (verdict.is_right()) verdict.orientation_error_rad = orientation_error(mission, *pair);
  }
  for (const auto& [id, landmark] : graph.landmarks())
    if (std::ranges::find(pairs, &landmark, &FoundThing::landmark) == pairs.end())
      verdicts.push_back({"", landmark.category, 0.0, std::nullopt, known.driven_m(id)});
  return verdicts;
}

}  // namespace cairn
