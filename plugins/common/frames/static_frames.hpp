// Where sensors are mounted, as /tf_static says: frames that hang on each other.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn::frames {

// A sensor seen from above.
struct Mounted {
  Pose2 T_base_sensor;
  bool is_upside_down = false;  // its angles grow clockwise
};

class StaticFrames {
 public:
  static constexpr std::size_t kMaxFrames = 512;

  // A child that is known already moves. False, and nothing has changed: numbers that are no pose, a frame without a
  // name or that hangs on itself, or too many.
  [[nodiscard]] bool add(const std::string& parent, const std::string& child, const Eigen::Vector3d& position_m,
                         const Eigen::Quaterniond& rotation);
  // None: no frames lead from one to the other, or the sensor looks up or down. The base itself is always there.
  [[nodiscard]] std::optional<Mounted> find(const std::string& base, const std::string& sensor) const;
  // In alphabetical order.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  struct Frame {
    std::string parent;
    Eigen::Isometry3d T_parent_frame;
  };
  struct FromRoot {
    std::string root;
    Eigen::Isometry3d T_root_frame;
  };
  // None: the frames go round in a circle.
  [[nodiscard]] std::optional<FromRoot> from_root(std::string frame) const;

  std::map<std::string, Frame> frames_;  // by their own name
};

}  // namespace cairn::frames
