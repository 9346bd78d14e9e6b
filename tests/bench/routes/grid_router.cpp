#include "tests/bench/routes/grid_router.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

const ModuleLibrary& library() {
  static const ModuleLibrary library({CAIRN_BINARY_DIR "/lib/cairn"});
  return library;
}

}  // namespace

GridRouter::GridRouter(OccupancyGrid grid, const RobotModel& robot, const std::string& settings)
    : grid_(std::move(grid)), robot_(robot) {
  const PluginChoice choice{"ompl", parse_config_text(settings.empty() ? "{}" : settings, "settings of ompl")};
  ModuleContext context{robot_};
  context.modules = &library();
  planner_ = library().make<Planner>(choice, context);
  planner_->prepare(world(), robot_.radius_m);
}

GridRouter::GridRouter(OccupancyGrid grid, double radius_m, const std::string& settings)
    : GridRouter(
          std::move(grid),
          [&] {
            RobotModel robot;
            robot.radius_m = radius_m;
            return robot;
          }(),
          settings) {}

WorldView GridRouter::world() const {
  WorldView view{grid_, graph_, robot_, {}, 0.0, nullptr, 0.0};
  view.grid_version = 1;
  view.speed_law = speed_law_;
  return view;
}

PlanResult GridRouter::plan(const PlanRequest& request, double budget_ms) const {
  Budget budget;
  if (budget_ms > 0.0)
    budget.deadline = Budget::Clock::now() + std::chrono::microseconds(std::llround(budget_ms * 1e3));
  return planner_->plan(request, world(), budget);
}

PlanResult GridRouter::plan(const Point& from, const Point& to, double budget_ms, std::uint64_t seed) const {
  PlanRequest request;
  request.from.pose = Pose2{from.x(), from.y(), 0.0};
  request.to.pose = Pose2{to.x(), to.y(), 0.0};
  request.radius_m = robot_.radius_m;
  request.seed = seed;
  return plan(request, budget_ms);
}

std::vector<Point> points_of(const PlanResult& result) {
  std::vector<Point> points;
  for (const Pose2& pose : result.path) points.push_back(pose.position());
  return points;
}

TimedPlan timed_plan(const GridRouter& router, const Point& from, const Point& to) {
  const auto begin = Budget::Clock::now();
  TimedPlan timed{router.plan(from, to), 0.0};
  timed.took_ms = std::chrono::duration<double, std::milli>(Budget::Clock::now() - begin).count();
  return timed;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

}  // namespace cairn
