#include "tests/bench/tags/tag_home.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "framework/experiments/homes/tag_sight.hpp"
#include "framework/experiments/trials/true_space.hpp"
#include "framework/files/world_file.hpp"
#include "maps/base/output_file.hpp"
#include "maps/base/portable_random.hpp"

namespace cairn {
namespace {

constexpr double kRobotRadius_m = 0.25;
constexpr double kOffTag_rad = radians(20.0);
constexpr int kRings = 4;  // of a metre each
constexpr double kMinDistance_m = 0.4;

Pose2 looking_at(const Point& at_m, const WorldTag& tag, const CameraModel& camera) {
  const Point to_tag_m = tag.T_map_tag.position() - at_m;
  return {at_m.x(), at_m.y(), wrap_angle(std::atan2(to_tag_m.y(), to_tag_m.x()) - camera.T_robot_camera.theta_rad)};
}

}  // namespace

TaggedHome tagged_home(const PhotoPlan& plan, std::uint64_t seed) {
  HomesConfig config;
  config.tags = plan.tags;
  TaggedHome tagged{random_home(config, seed), {}};
  const auto file = std::filesystem::temp_directory_path() / ("tagged_home_" + std::to_string(seed) + ".yaml");
  write_file(file, tagged.home.world_yaml);
  tagged.world = load_world(file, {});
  std::filesystem::remove(file);
  return tagged;
}

std::vector<Pose2> photo_places(const PhotoPlan& plan, const TaggedHome& home, const CameraModel& camera,
                                std::uint64_t seed) {
  const std::vector<Point> reached_m = TrueSpace(home.world, kRobotRadius_m).reached_from(home.home.start_m);
  const TagSight sight(home.world);
  PortableRandom random(seed, 9);
  std::vector<Pose2> places;
  for (const WorldTag& tag : home.world.tags) {
    std::vector<std::vector<Pose2>> rings(kRings);
    for (const Point& at_m : reached_m) {
      const Pose2 T_map_robot = looking_at(at_m, tag, camera);
      const auto sighted = sight.of(tag, camera, T_map_robot, {kRings - 1e-6, radians(60.0)});
      if (sighted && sighted->distance_m >= kMinDistance_m)
        rings[static_cast<std::size_t>(sighted->distance_m)].push_back(T_map_robot);
    }
    for (const std::vector<Pose2>& ring : rings)
      for (int k = 0; k < plan.per_ring && !ring.empty(); ++k) {
        Pose2 T_map_robot = ring[static_cast<std::size_t>(random.whole(0, static_cast<int>(ring.size()) - 1))];
        T_map_robot.theta_rad = wrap_angle(T_map_robot.theta_rad + random.between(-kOffTag_rad, kOffTag_rad));
        places.push_back(T_map_robot);
      }
  }
  return places;
}

}  // namespace cairn
