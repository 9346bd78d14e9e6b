// The goals of a mission, each a leaf of its tree, judged by the true world: could it be reached, was it, and what
// stood against it.
#pragma once

#include <string>
#include <vector>

#include "framework/experiments/trials/config.hpp"
#include "framework/experiments/trials/record.hpp"
#include "framework/mission/mission.hpp"
#include "framework/mission/runner.hpp"

namespace cairn {

enum class GoalEnd : std::uint8_t {
  reached,        // the robot was truly there when the behaviour said so
  false_success,  // it said so, and the robot was elsewhere
  failed,         // it said that it could not
  halted          // a node above it ended it, or the mission did
};
[[nodiscard]] std::string_view name_of(GoalEnd end);

struct GoalVerdict {
  std::string path;  // of the leaf
  std::string goal;  // "goto (1.00, 2.00)"
  double begin_s = 0.0;
  double end_s = 0.0;
  GoalEnd end = GoalEnd::halted;
  std::string reason;     // what the leaf said
  double missed_m = 0.0;  // beyond its tolerance; of a success that was none
  // All its places have room and were joined to the robot's place at some time while it was under way.
  bool is_reachable = false;
  // Its places were known in the map with which the mission ended; of a landmark: when it ended, the map held one of
  // its category where there is one.
  bool is_mapped = false;
  bool is_struck = false;     // a fault was active while it was under way, or the battery was empty
  bool is_displaced = false;  // the estimate was still off by what a kidnapping, a slip or a compass jump had done
};

struct TrialEvidence {
  const Mission& mission;
  const MissionResult& result;
  const TrialRecord& record;
  const OccupancyGrid* grid = nullptr;  // at the end; null: lost
};

// Goals are the leaves goto, tour, patrol and return_home that were begun, in the order of the tree. One that ran
// several times (retry, repeat) is under way from its first begin to its last end, and ended as the last time. A
// success counts as reached when the robot's true place is within off_m and the leaf's tolerance_m of the goal at its
// end; of several places it must have been that near to each. Of a landmark: to where the map says that one stands
// beside it, or its disc to the outline; if the map held one of the category where in truth there is one. Throws
// ConfigError on settings that are none of these modules'.
[[nodiscard]] std::vector<GoalVerdict> judge_goals(const TrialsConfig& config, const TrialEvidence& evidence);

}  // namespace cairn
