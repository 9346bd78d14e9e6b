#include "framework/experiments/homes/tag_record.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kPlacesApart_m = 0.2;
constexpr std::size_t kMinPlaces = 3;

const WorldTag* tag_of(const World& world, const MarkerId& marker) {
  const auto found = std::ranges::find(world.tags, marker, &WorldTag::marker);
  return found == world.tags.end() ? nullptr : &*found;
}

}  // namespace

void TagRecord::on(const Event& event, const MissionView& view) {
  if (!std::holds_alternative<TickDone>(event) || !view.truth || view.world.observation == nullptr) return;
  for (const MarkerSighting& sighting : view.world.observation->markers) {
    ++sightings_;
    false_sightings_ += tag_of(world_, sighting.marker) == nullptr ? 1 : 0;
  }
  const Pose2& T_map_robot = view.truth->T_map_robot;
  for (const CameraImage& image : view.world.observation->images)
    for (const WorldTag& tag : world_.tags) {
      std::vector<Point>& places_m = seen_from_m_[tag.marker];
      const CameraModel& camera = view.world.robot.cameras.at(static_cast<std::size_t>(image.camera));
      const bool is_near = std::ranges::any_of(
          places_m, [&](const Point& p_m) { return (p_m - T_map_robot.position()).norm() < kPlacesApart_m; });
      if (places_m.size() < kMinPlaces && !is_near && sight_.of(tag, camera, T_map_robot, {}))
        places_m.push_back(T_map_robot.position());
    }
}

bool TagRecord::was_in_sight(const MarkerId& marker) const {
  const auto places = seen_from_m_.find(marker);
  return places != seen_from_m_.end() && places->second.size() >= kMinPlaces;
}

TagVerdict TagRecord::verdict(const LandmarkGraph& graph, double tolerance_m) const {
  TagVerdict verdict;
  verdict.hung = static_cast<int>(world_.tags.size());
  verdict.in_sight = static_cast<int>(
      std::ranges::count_if(world_.tags, [&](const WorldTag& tag) { return was_in_sight(tag.marker); }));
  verdict.sightings = sightings_;
  verdict.false_sightings = false_sightings_;
  for (const auto& [id, landmark] : graph.landmarks()) {
    if (!landmark.marker) continue;
    const WorldTag* const tag = tag_of(world_, *landmark.marker);
    const Pose2& T_map_landmark = landmark.T_map_landmark;
    const double error_m = tag == nullptr ? 0.0 : (T_map_landmark.position() - tag->T_map_tag.position()).norm();
    if (tag == nullptr || error_m > tolerance_m) {
      ++verdict.false_landmarks;
      continue;
    }
    ++(was_in_sight(tag->marker) ? verdict.found : verdict.found_besides);
    verdict.position_error_m.push_back(error_m);
    verdict.direction_error_deg.push_back(
        degrees(std::abs(wrap_angle(T_map_landmark.theta_rad - tag->T_map_tag.theta_rad))));
  }
  return verdict;
}

}  // namespace cairn
