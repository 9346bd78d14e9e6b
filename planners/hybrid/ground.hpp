// The ground that a path over landmarks is checked, planned and shortened on: a whole grid, or windows of a large one
// (windows.hpp).
#pragma once

#include "framework/contracts/path_planner.hpp"
#include "planners/common/disc_space/driving_time.hpp"
#include "planners/common/disc_space/routes.hpp"

namespace cairn {

class PlanningGround {
 public:
  virtual ~PlanningGround() = default;
  [[nodiscard]] virtual const WorldView& world() const = 0;
  // The disc with its margin, a hair more, and what is added, moves along the straight line.
  [[nodiscard]] virtual bool fits_with(const Point& from, const Point& to, double added_m) const = 0;
  [[nodiscard]] bool fits_along(const Point& from, const Point& to) const { return fits_with(from, to, 0.0); }
  // Where that disc stands at a landmark.
  [[nodiscard]] virtual std::optional<Pose2> approach(const Landmark& landmark) const = 0;
  [[nodiscard]] virtual PathResult path(const PathRequest& request, const Budget& budget) const = 0;
  // What a disc keeps along a route from what is blocked.
  [[nodiscard]] virtual double clearance_m(const std::vector<Point>& route, double radius_m) const = 0;
  [[nodiscard]] virtual double driving_time_s(const std::vector<Point>& route, const DrivingRules& rules) const = 0;
  // For that disc and what is added.
  [[nodiscard]] virtual ShortcutRules shortcuts(double added_m) const = 0;
};

class WholeGround : public PlanningGround {
 public:
  // All must outlive it. disc_m: radius of that disc.
  WholeGround(const WorldView& world, const DiscSpace& space, double disc_m, const PathPlanner& path_planner)
      : world_(world), space_(space), disc_m_(disc_m), path_planner_(path_planner) {}

  [[nodiscard]] const WorldView& world() const override { return world_; }
  [[nodiscard]] bool fits_with(const Point& from, const Point& to, double added_m) const override {
    return space_.fits_along(from, to, disc_m_ + added_m);
  }
  [[nodiscard]] std::optional<Pose2> approach(const Landmark& landmark) const override {
    return approach_pose(space_, landmark, disc_m_);
  }
  [[nodiscard]] PathResult path(const PathRequest& request, const Budget& budget) const override {
    return path_planner_.plan(request, world_, budget);
  }
  [[nodiscard]] double clearance_m(const std::vector<Point>& route, double radius_m) const override {
    return clearance_along(space_, route, radius_m);
  }
  [[nodiscard]] double driving_time_s(const std::vector<Point>& route, const DrivingRules& rules) const override {
    return cairn::driving_time_s(space_.field(), route, rules);
  }
  [[nodiscard]] ShortcutRules shortcuts(double added_m) const override {
    return shortcuts_on(space_, disc_m_ + added_m);
  }

 private:
  const WorldView& world_;
  const DiscSpace& space_;
  double disc_m_;
  const PathPlanner& path_planner_;
};

}  // namespace cairn
