#include "plugins/behaviours/local_map/recent_echoes.hpp"

namespace cairn::behaviours {

void RecentEchoSettings::describe(Fields<RecentEchoSettings>& fields) {
  fields.number("kept_s", &RecentEchoSettings::kept_s, {0.1, 3600.0}, "s",
                "near echoes correct the map for once to twice this time: people leave");
  fields.group("near", &RecentEchoSettings::near, "what near echoes say about cells");
}

void RecentEchoes::see(const WorldView& world) {
  if (!now_) return forget(world);
  if (world.time_s - since_s_ > settings_.kept_s) {
    now_ = std::move(later_);
    later_.emplace(world.grid, settings_.near);
    since_s_ = world.time_s;
  }
  add(world);
}

void RecentEchoes::forget(const WorldView& world) {
  now_.emplace(world.grid, settings_.near);
  later_.emplace(world.grid, settings_.near);
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
