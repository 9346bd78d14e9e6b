// How far an exploration has come, for people: which share of what stands in the map the robot has passed closely.
//
// The share of the map that is known says little: half of it is known after a look round, and the path passes every
// edge after that.
#pragma once

#include <optional>

#include "framework/contracts/world_view.hpp"
#include "plugins/behaviours/exploring/settings.hpp"
#include "plugins/behaviours/local_map/cell_layer.hpp"
#include "plugins/behaviours/places/map_watch.hpp"

namespace cairn::behaviours {

class ExploreProgress {
 public:
  // near_m: what the robot's centre comes nearer to has been passed.
  ExploreProgress(const WorldView& world, double near_m, const EstimateSettings& settings = {});

  // In every tick; counts the map every few seconds only. As if the rest took as long for each cell as what is passed
  // has; nothing before there is anything to go by.
  [[nodiscard]] std::optional<double> left_s(const WorldView& world);

 private:
  void pass(const WorldView& world);
  [[nodiscard]] double passed_ratio(const OccupancyGrid& grid) const;

  double near_m_;
  EstimateSettings settings_;
  double begun_s_;
  double counted_s_;
  Point marked_m_{1e9, 1e9};
  CellSet passed_;
  std::optional<double> left_at_count_s_;
  MapWatch map_watch_;
};

}  // namespace cairn::behaviours
