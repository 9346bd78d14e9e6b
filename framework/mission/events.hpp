// The event stream of a mission. Listeners (reports, pictures, progress) subscribe to it; they see
// values and can never change what happens.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "framework/behaviour_tree/nodes.hpp"
#include "framework/contracts/behaviour.hpp"
#include "framework/contracts/detector.hpp"
#include "framework/contracts/ground_truth.hpp"
#include "framework/contracts/world_view.hpp"
#include "framework/safety/deaf_transducers.hpp"

namespace cairn {

// After each tick; the view holds the new state.
struct TickDone {
  const CellChanges* changes = nullptr;  // what of the grid may have changed with it; null: nothing
};
struct MatchingDone {
  Matching matching;
};
struct LandmarkChanged {
  Landmark landmark;
  bool is_new = false;
};
struct LandmarkRetired {
  Landmark landmark;
  std::string reason;
};
struct PlanDone {
  PlanResult result;
};
// A behaviour begins to follow a path: one of a planner's, a part of it, or one that the behaviour has made itself, as
// explore does.
struct PathStarted {
  std::vector<Point> path;  // map frame, never empty
};
struct StepStarted {
  int index = 0;
  std::string name;
};
struct StepEnded {
  int index = 0;
  std::string name;
  Status status;
};
// Of nodes below a step. One that begins and ends in one tick, as it did the last time, is not published again.
struct NodeStarted {
  std::string path;  // "3/1/2"
  std::string name;
  NodeKind kind = NodeKind::behaviour;
};
struct NodeEnded {
  std::string path;
  std::string name;
  NodeKind kind = NodeKind::behaviour;
  Status status;
  bool is_halted = false;  // a failure
};
struct MapSaved {
  std::string file_name;
};
// Published when it has happened, at a moment that differs from run to run: not for reports.
struct Autosaved {
  std::string file_name;
  double time_s = 0.0;   // of the mission, up to which the file holds everything
  double took_ms = 0.0;  // wall clock, from taking the copy to the file on the disk
};
// The first time only; the mission goes on.
struct AutosaveFailed {
  std::string reason;
};
// The robot was stopped because ticks had stopped ending, and drives on. At a moment that differs from run to run: not
// for reports.
struct Stalled {
  std::string stage;   // where the mission was then; empty: the whole process was held up
  std::string module;  // empty: the host itself
  double for_s = 0.0;  // wall clock since the tick before
};
struct Message {
  std::string sentence;
};
struct Bumped {};
// The robot itself lets nobody drive it: an emergency stop. And lets it be driven again.
struct RobotStopped {
  std::string by;  // "the emergency topic /e_stop"
};
struct RobotReleased {
  std::string by;
  double stopped_s = 0.0;  // by the mission's clock
};
// Transducers that the collision monitor does not believe any more when they say "no echo", and those of them that have
// heard something again. Numbers rise.
struct WentDeaf {
  std::vector<int> sensors;
  DeafCause cause = DeafCause::missed_echo;
};
struct HearsAgain {
  std::vector<int> sensors;
};
// The mission's clock stands from here on: the robot is stopped, readings still come.
struct Paused {};
struct Resumed {
  std::optional<double> paused_s;  // by the robot's clock; none for a log, whose clock stood
};

using Event = std::variant<TickDone, MatchingDone, LandmarkChanged, LandmarkRetired, PlanDone, PathStarted, StepStarted,
                           StepEnded, NodeStarted, NodeEnded, MapSaved, Autosaved, AutosaveFailed, Stalled, Message,
                           Bumped, RobotStopped, RobotReleased, WentDeaf, HearsAgain, Paused, Resumed>;

// What listeners see beside the event. Valid during the call only.
struct MissionView {
  const WorldView& world;
  const CoarseGrid* coarse = nullptr;
  Twist commanded{};                   // what the wheels were last ordered to do
  std::optional<GroundTruth> truth{};  // with the world's observation, where it is known
};

class Listener {
 public:
  virtual ~Listener() = default;
  virtual void on(const Event& event, const MissionView& view) = 0;
};

}  // namespace cairn
