// Compass readings as headings of the pose graph, with what such readings are worth: white noise, a bias of the whole
// run (how the compass is mounted, where north is), a bias that changes along the way, and now and then steel that
// turns it by any angle. That bias is why many readings on a short stretch count little more than one.
#pragma once

#include <optional>

#include "framework/contracts/robot_model.hpp"
#include "plugins/submap_graph/config.hpp"
#include "plugins/submap_graph/tied_graph.hpp"

namespace cairn::submap_graph {

// Standard deviations.
struct Compass {
  double noise_rad = 0.0;  // 0: there is none, or it is not used
  double bias_rad = 0.0;
  double local_bias_rad = 0.0;
  double local_scale_m = 1.0;  // the way on which the local bias forgets itself
};
// By the robot's file, and at least by the settings.
[[nodiscard]] Compass compass_of(const Config& config, const RobotModel& robot);

class CompassHeadings {
 public:
  explicit CompassHeadings(const Compass& compass) : compass_(compass) {}

  // Of the graph's latest node; step_m: the way from the node before.
  void add(std::optional<double> compass_rad, double step_m, TiedGraph& graph);

 private:
  Compass compass_;
  std::size_t group_ = 0;
  double in_group_m_ = 0.0;
  bool has_begun_ = false;
};

}  // namespace cairn::submap_graph
