// What the mission knows, as its ticks go on.
//
// The loop puts the value of each stage here for those who look on: behaviours, planners and listeners. Stages
// themselves get values and return them.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "framework/contracts/world_view.hpp"
#include "framework/mission/events.hpp"
#include "framework/safety/collision_monitor.hpp"

namespace cairn {

struct WorldState {
  const RobotModel& robot;
  const LandmarkGraph& graph;
  Pose2 T_map_start;                    // a mission that was resumed: where it began at first
  const OccupancyGrid* grid = nullptr;  // of the mapper; null before the run, and when its module was given up with it
  const CoarseGrid* coarse = nullptr;   // of the detector; may be null
  Observation observation{};
  bool has_observation = false;
  std::optional<GroundTruth> truth{};  // with the observation; in no view for modules
  PoseEstimate pose{};
  double time_s = 0.0;
  DriveCommand driven{};
  const Hierarchies* hierarchies = nullptr;  // for the names of clusters
  SpeedLaw speed_law{};                      // of the mission's collision monitor
  const LandmarkGraph no_landmarks{};
  const OccupancyGrid* map_before = nullptr;  // of a robot that was carried, until it has found itself; else null
  Pose2 T_map_before{};                       // where it was believed to be in that map last
  std::uint64_t map_moves = 0;
  const MapMove* last_map_move = nullptr;

  void observe(Observation seen, const std::optional<GroundTruth>& truth_then) {
    observation = std::move(seen);
    truth = truth_then;
    has_observation = true;
  }
  // Another map takes the place of the one so far. move: how places move with that; null: they have none in it. It must
  // outlive the next call.
  void exchange_map(const OccupancyGrid& map, const MapMove* move) {
    grid = &map;
    coarse = nullptr;
    ++map_moves;
    last_map_move = move;
  }
  // The robot was carried: from here on it draws a map of its own.
  void lose(const PoseEstimate& own_pose, const OccupancyGrid& own_grid, const OccupancyGrid& before,
            const Pose2& T_map_robot_before) {
    pose = own_pose;
    pose.trust = PoseTrust::lost;
    exchange_map(own_grid, nullptr);
    map_before = &before;
    T_map_before = T_map_robot_before;
  }
  [[nodiscard]] bool is_lost() const { return pose.trust == PoseTrust::lost; }
  // Landmarks of a map have no place in the frame of a robot that is lost.
  [[nodiscard]] const LandmarkGraph& known_graph() const { return is_lost() ? no_landmarks : graph; }
  // The mission's map: not what a robot draws that is lost. There must be a grid.
  [[nodiscard]] const OccupancyGrid& mission_map() const { return map_before == nullptr ? *grid : *map_before; }
  // There must be a grid.
  [[nodiscard]] WorldView view() const;
  [[nodiscard]] double explored_ratio() const;  // 0 without a grid
};

}  // namespace cairn
