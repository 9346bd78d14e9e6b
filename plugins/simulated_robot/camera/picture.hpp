// What a camera sees of a scene: floor, walls, a bright ceiling, and the tags on the walls, with the light that they
// send back (0 black, 1 white). Whatever stands on the floor is as high as the walls, and hides what is behind it.
#pragma once

#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/world.hpp"
#include "plugins/common/camera/lens.hpp"
#include "plugins/simulated_robot/camera/tag_pattern.hpp"
#include "plugins/simulated_robot/surroundings/scene.hpp"

namespace cairn {

class Picture {
 public:
  // The scene and the tags must outlive the object.
  Picture(const CameraModel& camera, const Scene& scene, const std::vector<WorldTag>& tags);

  // Row by row from the upper left; valid until the next call.
  const std::vector<float>& take(const Pose2& T_map_robot);

  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  Picture(Picture&&) = default;

 private:
  class HungTag;
  struct Box {
    int left = 0, top = 0, right = 0, bottom = 0;  // the last two not in it
  };

  void draw_surroundings(const Pose2& T_map_camera);
  void draw_tag(const WorldTag& tag, const TagPattern& pattern, const Pose2& T_map_robot);
  [[nodiscard]] float tag_light(const HungTag& hung, std::size_t pixel) const;
  [[nodiscard]] float tag_light(const HungTag& hung, std::size_t pixel, int row, int column) const;
  [[nodiscard]] Box box_of(const WorldTag& tag, const Pose2& T_robot_tag, double half_m) const;
  [[nodiscard]] std::size_t ray_at(double bearing_rad) const;

  CameraModel camera_;
  const Scene& scene_;
  const std::vector<WorldTag>& tags_;
  std::vector<TagPattern> patterns_;
  // Of each pixel: where it looks on the plane ahead, its bearing, and how much it rises a metre.
  std::vector<Eigen::Vector2f> on_plane_;
  std::vector<float> bearing_rad_;
  std::vector<float> slope_;
  double first_rad_ = 0.0;
  double step_rad_ = 0.0;
  std::vector<double> wall_m_;    // along each ray of a fan over all bearings
  std::vector<float> wall_grey_;  // how bright it is there
  std::vector<float> light_;
};

}  // namespace cairn
