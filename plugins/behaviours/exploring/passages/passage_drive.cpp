#include "plugins/behaviours/exploring/passages/passage_drive.hpp"

namespace cairn::behaviours {
namespace {

RouteSettings passage_route_settings(const ExploreConfig& config) {
  RouteSettings settings;
  settings.speed_mps = config.speed_mps;
  settings.tolerance_m = 0.15;
  settings.patience_s = config.exploring.blocked.patience_s;
  settings.rounds = 3;
  settings.driving = config.driving;
  settings.driving.look.max_looks = 4;
  settings.driving.look.at_most_s = 6.0;
  return settings;
}

}  // namespace

PassageDrive::PassageDrive(const ExploreConfig& config)
    : settings_(config.exploring.passages), driver_(passage_route_settings(config), 1) {}

void PassageDrive::begin(const ExploreTask& /*task*/, double time_s) {
  driver_.restart();
  begun_s_ = time_s;
}

bool PassageDrive::is_beyond(const ExploreTask& task, const WorldView& world) const {
  if (task.kind != TaskKind::passage) return false;
  const Point robot = world.pose.T_map_robot.position();
  const Point ahead = task.lookout - task.about;
  const double in_m = (robot - task.about).dot(ahead.normalized());
  return in_m > world.robot.radius_m + 0.2 && (robot - task.about).norm() < 1.5;
}

Status PassageDrive::tick(const ExploreTask& task, const WorldView& world, BehaviourContext& context) {
  if (is_beyond(task, world)) return {StepState::success, {}};
  if (world.time_s - begun_s_ > settings_.at_most_s * (task.kind == TaskKind::passage ? 1.0 : 2.0))
    return {StepState::failure, "it takes too long"};
  return driver_.tick(Place{Pose2{task.lookout.x(), task.lookout.y(), 0.0}, false, {}}, world, context);
}

}  // namespace cairn::behaviours
