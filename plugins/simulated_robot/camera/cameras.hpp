// The robot's cameras: when each one takes a picture, and what lens and sensor make of the light: blur, exposure,
// noise.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/contracts/camera_image.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/world.hpp"
#include "plugins/simulated_robot/camera/picture.hpp"
#include "plugins/simulated_robot/noise_stream.hpp"
#include "plugins/simulated_robot/surroundings/scene.hpp"

namespace cairn {

class Cameras {
 public:
  // The scene must outlive the object.
  Cameras(const RobotModel& robot, const World& world, const Scene& scene, std::uint64_t seed);
  Cameras(const Cameras&) = delete;  // pictures refer to its tags
  Cameras& operator=(const Cameras&) = delete;

  // Adds the pictures that are due after before_s and by now_s.
  void take(const Pose2& T_map_robot, double before_s, double now_s, std::vector<CameraImage>& images);

 private:
  struct Camera {
    CameraModel model;
    Picture picture;
    NoiseStream noise;
  };

  std::vector<WorldTag> tags_;
  std::vector<Camera> cameras_;
};

}  // namespace cairn
