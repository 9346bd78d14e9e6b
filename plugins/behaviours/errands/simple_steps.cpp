#include "plugins/behaviours/errands/simple_steps.hpp"

#include <cstdio>
#include <random>

#include "plugins/behaviours/errands/file_name.hpp"

namespace cairn::behaviours {
namespace {

double corner_at(const Point& before, const Point& corner, const Point& after) {
  const Point in = corner - before;
  const Point out = after - corner;
  return std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)));
}

std::vector<Point> scattered(std::vector<Point> points_m, double max_m, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto offset_m = [&] { return max_m * (static_cast<double>(random() >> 11) * 0x1.0p-52 - 1.0); };
  for (Point& p_m : points_m) {
    const double x_m = offset_m();  // in this order on every compiler
    p_m += Point(x_m, offset_m());
  }
  return points_m;
}

}  // namespace

void DriveConfig::describe(Fields<DriveConfig>& fields) {
  using C = DriveConfig;
  fields.points("points_m", &C::points_m, "m", "places of the map, driven to in this order in straight lines")
      .required = true;
  fields.number("speed_mps", &C::speed_mps, {0.01, 5.0}, "m/s", "top speed, within the robot's own limits");
  fields.number("tolerance_m", &C::tolerance_m, {0.01, 1.0}, "m", "this near to a point is there");
  fields.number("patience_s", &C::patience_s, {0.1, 3600.0}, "s", "blocked for longer than this, the step has failed");
  fields.number("scatter_m", &C::scatter_m, {0.0, 100.0}, "m",
                "each point is moved by up to this in x and in y, by chance of the seed: for experiments over many "
                "paths");
  fields.angle("stop_at_corner_deg", &C::stop_at_corner_rad, {0.0, 180.0},
               "at a point where it turns by more than this it stops; it drives through the others");
  fields.shorthand("points_m");
}

DriveTo::DriveTo(const DriveConfig& config, std::uint64_t seed)
    : config_(config),
      seed_(seed),
      points_m_(scattered(config.points_m, config.scatter_m, seed)),
      stretch_(config.speed_mps, config.tolerance_m, ProgressChecker(config.patience_s)) {}

void DriveTo::halt() {
  *this = DriveTo(config_, seed_);
}

void DriveTo::begin_stretch(const Point& from) {
  std::vector<Point> points{from};
  do {
    points.push_back(points_m_[next_++]);
  } while (next_ < points_m_.size() &&
           corner_at(points[points.size() - 2], points.back(), points_m_[next_]) < config_.stop_at_corner_rad);
  stretch_.begin(std::move(points));
}

Status DriveTo::tick(const WorldView& world, BehaviourContext& context) {
  const Pose2& pose = world.pose.T_map_robot;
  if (!begun_ && !points_m_.empty()) begin_stretch(pose.position());
  begun_ = true;
  char text[96];
  if (stretch_.is_stuck(world)) {
    const Point end = stretch_.path().back();
    std::snprintf(text, sizeof text, "blocked at (%.2f, %.2f) on the way to (%.2f, %.2f)", pose.x_m, pose.y_m, end.x(),
                  end.y());
    return {StepState::failure, text};
  }
  ControlResult step = stretch_.ask(context);
  if (step.state == ControlState::arrived) {
    if (next_ >= points_m_.size()) return {StepState::success, "drove all points"};
    begin_stretch(stretch_.path().back());
    step = stretch_.ask(context);
  }
  stretch_.drive(step.twist, context);
  std::snprintf(text, sizeof text, "driving to (%.2f, %.2f)", stretch_.path().back().x(), stretch_.path().back().y());
  return {StepState::running, text, left_s(step, world.robot)};
}

// To the last point, as if never blocked.
double DriveTo::left_s(const ControlResult& step, const RobotModel& robot) const {
  double left_m = step.left_m;
  for (std::size_t i = next_; i < points_m_.size(); ++i)
    left_m += (points_m_[i] - (i == next_ ? stretch_.path().back() : points_m_[i - 1])).norm();
  return left_m / std::min(config_.speed_mps, robot.max_v_mps);
}

void WaitConfig::describe(Fields<WaitConfig>& fields) {
  fields.number("for_s", &WaitConfig::for_s, {0.0, 1e6}, "s", "how long to stand still");
  fields.shorthand("for_s");
}

Status Wait::tick(const WorldView& world, BehaviourContext&) {
  if (!begun_s_) begun_s_ = world.time_s;
  if (world.time_s - *begun_s_ < config_.for_s)
    return {StepState::running, "waiting", config_.for_s - (world.time_s - *begun_s_)};
  return {StepState::success, "waited"};
}

void SaveConfig::describe(Fields<SaveConfig>& fields) {
  fields.raw("file", &SaveConfig::file, "text", "name of the saved map in the output folder, NAME.cairn").required =
      true;
  fields.shorthand("file");
}

// Maps are saved into the output folder.
Save::Save(const SaveConfig& config) : file_name_(file_name_of(config.file, "map.cairn", ".cairn")) {}

Status Save::tick(const WorldView&, BehaviourContext& context) {
  return context.save(file_name_);
}

}  // namespace cairn::behaviours
