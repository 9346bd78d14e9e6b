// The robot's body among the world's walls and objects: it moves along an arc until it touches.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/world.hpp"
#include "plugins/simulated_robot/surroundings/scene.hpp"

namespace cairn {

// The pose after driving an arc of the given length (negative: backwards) and turn.
[[nodiscard]] Pose2 along_arc(double distance_m, double turn_rad);

struct Move {
  double distance_m = 0.0;  // driven, with its sign
  double turn_rad = 0.0;
  bool touched = false;  // something cut the move short
  Pose2 T_map_touch{};   // where, when it did
};

// The nearest place of a footprint's surroundings.
struct Nearest {
  Point at_m{0.0, 0.0};
  double distance_m = std::numeric_limits<double>::infinity();
  const Face* face = nullptr;             // the straight face that it lies on,
  const RoundFace* round_face = nullptr;  // or the round one
};

class Body {
 public:
  // The scene must outlive the object.
  Body(const RobotModel& robot, const Scene& scene);

  // Distance from the footprint to the nearest face, negative when they overlap. A lower bound when
  // a footprint that is not round is far from everything.
  [[nodiscard]] double clearance_m(const Pose2& T_map_robot) const;

  // Drives as far along the arc as the footprint stays clear, to less than a micrometre; never
  // jumps anything, however thin (no step is longer than the clearance, or a fifth of a millimetre). What is left of
  // the turn is then made on the spot, as far as that is free. A move that leads away is always possible.
  [[nodiscard]] Move drive(Pose2& T_map_robot, double distance_m, double turn_rad) const;

  // The share of a straight path (map frame, no turning) that the footprint can go and keep gap_m from
  // everything, found in the same manner.
  [[nodiscard]] double slide(const Pose2& T_map_robot, const Point& way_m, double gap_m) const;

  // The place of the scene that is nearest to the footprint. Valid while the scene stays as it is.
  [[nodiscard]] Nearest nearest(const Pose2& T_map_robot) const;

 private:
  // Moves the pose as far along the arc as it is free; the share of the arc that is done.
  [[nodiscard]] double free_share(Pose2& T_map_robot, double distance_m, double turn_rad) const;
  template <class PoseAt>
  [[nodiscard]] double furthest(Pose2& T_map_robot, double sweep_m, double gap_m, PoseAt pose_at) const;
  [[nodiscard]] double footprint_clearance_m(const Pose2& T_map_robot) const;

  double radius_m_;
  std::vector<Point> polygon_m_;
  const Scene& scene_;
};

// What the robot would overlap at this pose, as people call it ("wall 2", "object 3 (square)"), or nothing. Doors and
// movers are not looked at.
[[nodiscard]] std::optional<std::string> blocker_at(const Pose2& T_map_robot, const RobotModel& robot,
                                                    const World& world);

}  // namespace cairn
