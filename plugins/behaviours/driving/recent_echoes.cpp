#include "plugins/behaviours/driving/recent_echoes.hpp"

namespace cairn::behaviours {
namespace {
constexpr double kKept_s = 15.0;
}  // namespace

void RecentEchoes::see(const WorldView& world) {
  if (!now_) return forget(world);
  if (world.time_s - since_s_ > kKept_s) {
    now_ = std::move(later_);
    later_.emplace(world.grid);
    since_s_ = world.time_s;
  }
  add(world);
}

void RecentEchoes::forget(const WorldView& world) {
  now_.emplace(world.grid);
  later_.emplace(world.grid);
  since_s_ = world.time_s;
  add(world);
}

void RecentEchoes::add(const WorldView& world) {
  const Pose2& pose = world.pose.T_map_robot;
  for (NearEchoes* echoes : {&*now_, &*later_}) {
    if (world.observation != nullptr) echoes->see(*world.observation, pose);
    echoes->stand_at(pose.position(), world.robot.radius_m);
  }
}

}  // namespace cairn::behaviours
