// Controller: from a path to the velocity of this tick, past what is near.
#pragma once

#include <limits>
#include <span>
#include <string_view>

#include "framework/contracts/module_context.hpp"
#include "framework/contracts/world_view.hpp"

namespace cairn {

// How far the robot has come along a path: returned with each result, given back with the next request.
struct PathProgress {
  double along_m = 0.0;  // so much of the path is behind the robot
  bool turning = false;  // it turns in place at the moment
};

struct ControlRequest {
  std::span<const Point> path{};  // map frame, from where the robot was to the goal; empty: it has arrived
  // This path was not asked about before, or another behaviour has used the controller in between: whatever the
  // controller has kept of earlier requests must be forgotten. The host sets it, too.
  bool is_new_path = true;
  PathProgress progress{};   // of the last result for this path; of a new path along_m is 0
  double speed_mps = 0.2;    // top speed on this path, within the robot's own limits
  double tolerance_m = 0.1;  // the robot has arrived when it is this near to the end of the path
  // Slower for now, such as where the map is not trusted.
  double speed_limit_mps = std::numeric_limits<double>::infinity();
  // False: follow the path exactly whatever is near, as fast as is asked; only the collision monitor stops the robot.
  bool avoids_obstacles = true;
  std::span<const Point> obstacles{};  // near the robot, in its frame: cells of the map and fresh echoes
  Twist velocity{};                    // the robot's: as last commanded, less what the collision monitor has cut
  double period_s = 0.0;               // since the tick before: velocities change by no more than the robot can in it
};

enum class ControlState {
  following,
  blocked,  // nothing leads on past the obstacles: the robot is brought to a stop, the same request may be tried again
  arrived,  // at the end of the path: the robot is brought to a stop
};
[[nodiscard]] std::string_view name_of(ControlState state);

struct ControlResult {
  ControlState state = ControlState::following;
  Twist twist{};            // for this tick; finite
  Twist unhindered{};       // what the path alone asks for, without obstacles: progress is measured against it
  PathProgress progress{};  // along_m never falls on one path
  double left_m = 0.0;      // of the path
};

// One object serves all behaviours of a mission, one after the other.
class Controller {
 public:
  virtual ~Controller() = default;
  // Called at most a few times a tick, from one thread. The same requests in the same order give the same results.
  // Numbers that are not finite, in the path, the pose or the obstacles, give a finite twist. Throws only on bugs.
  virtual ControlResult control(const ControlRequest& request, const WorldView& world) = 0;
};

template <>
struct PluginTraits<Controller> {
  static constexpr PluginKind kKind = PluginKind::controller;
  using Context = ModuleContext;
};

}  // namespace cairn
