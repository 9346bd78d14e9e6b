// The module `ompl` on one map, asked as the program asks it: prepared, the map loaded.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/modules/module_library.hpp"

namespace cairn {

class GridRouter {
 public:
  // settings: of the module, in YAML; none are its own defaults.
  GridRouter(OccupancyGrid grid, const RobotModel& robot, const std::string& settings = "");
  GridRouter(OccupancyGrid grid, double radius_m, const std::string& settings = "");

  [[nodiscard]] PlanResult plan(const Point& from, const Point& to, double budget_ms = 0.0,
                                std::uint64_t seed = 1) const;  // budget 0: none
  [[nodiscard]] PlanResult plan(const PlanRequest& request, double budget_ms = 0.0) const;
  // From now on, paths are asked for a robot that is known.
  void set_speed_law(const SpeedLaw& law) { speed_law_ = law; }
  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }

 private:
  [[nodiscard]] WorldView world() const;

  OccupancyGrid grid_;
  LandmarkGraph graph_;
  RobotModel robot_;
  std::optional<SpeedLaw> speed_law_;
  std::shared_ptr<Planner> planner_;
};

[[nodiscard]] std::vector<Point> points_of(const PlanResult& result);

// A plan and what it took by the clock, in milliseconds.
struct TimedPlan {
  PlanResult result;
  double took_ms = 0.0;
};
[[nodiscard]] TimedPlan timed_plan(const GridRouter& router, const Point& from, const Point& to);

// The value below which that share of them lies; NaN of none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

}  // namespace cairn
