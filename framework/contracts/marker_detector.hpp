// MarkerDetector: recognises printed markers in the pictures of the robot's cameras.
#pragma once

#include <span>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "framework/contracts/camera_image.hpp"
#include "framework/contracts/marker.hpp"
#include "framework/contracts/module_context.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn {

class MarkerDetector {
 public:
  virtual ~MarkerDetector() = default;
  // The markers in each picture, by the cameras of ModuleContext::robot, in the order of the pictures; one that is in
  // two pictures has two sightings. Poses are in the robot's frame as it was at the picture's stamp, their covariances
  // positive definite. Ignores a picture whose camera or size the robot file does not have. Begins no picture once the
  // budget is exhausted.
  virtual std::vector<MarkerSighting> detect(std::span<const CameraImage> images, const Budget& budget) = 0;
};

template <>
struct PluginTraits<MarkerDetector> {
  static constexpr PluginKind kKind = PluginKind::marker_detector;
  using Context = ModuleContext;
};

}  // namespace cairn
