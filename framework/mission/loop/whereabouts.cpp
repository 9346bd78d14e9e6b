// How the mission knows where in a saved map the robot is: anywhere, where it was left, or carried meanwhile.

#include <fmt/format.h>

#include "framework/mission/loop/mission_loop.hpp"

namespace cairn {

void MissionLoop::begin_localisation(const LocaliseIn& localise) {
  localisation_.emplace();
  localisation_->is_pose_given = localise.T_map_start.has_value();
  perception_.leave_alone(*map_left_alone_, localise.map->graph, !localise.T_map_start);
  if (localise.T_map_start) return;
  world_.pose.trust = PoseTrust::lost;
  finder_.emplace(*map_left_alone_, mission_.robot);
}

// A log knows no other place than its own, and a robot that measures nothing cannot be checked.
void MissionLoop::begin_start_check() {
  if (!modules_.has_drive || (mission_.robot.sonars.empty() && mission_.robot.lasers.empty())) return;
  perception_.draw_own_map(build_localizer(mission_, library_, {modules_.T_map_start, own_frame(mission_.robot)}),
                           build_map(mission_, library_, nullptr));
  finder_.emplace(*grid_so_far_, mission_.robot);
  start_check_.emplace();
  if (modules_.find_myself) steps_.recover_by(modules_.find_myself, kFindMyself);
}

bool MissionLoop::is_start_open() const {
  return start_check_ && start_check_->is_open();
}

void MissionLoop::look_where_robot_is() {
  if (is_start_open())
    check_start();
  else
    find_itself();
}

// The own map begins where the robot is believed to be: as long as that is right, its frame is the map's.
void MissionLoop::check_start() {
  const Pose2& T_local_robot = perception_.own_pose().T_map_robot;
  if (!finder_->is_compared()) finder_->compare_with(modules_.T_map_start, T_local_robot);
  finder_->update(world_.observation, T_local_robot, perception_.own_grid(), world_.time_s);
  finder_->see_markers(world_.observation, T_local_robot, perception_.tracker().graph());
  if (finder_->looks().size() > start_check_->looks().size()) start_check_->update(finder_->looks().back());
  if (start_check_->trust() == StartTrust::carried) {
    lose_itself();
  } else if (start_check_->trust() == StartTrust::stayed) {
    perception_.drop_own_map();
    finder_.reset();
  }
}

// What was drawn and recognised since the run began was in the wrong place.
void MissionLoop::lose_itself() {
  world_.pose = perception_.own_pose();
  world_.pose.trust = PoseTrust::lost;
  world_.grid = &perception_.lose();
  world_.coarse = nullptr;
  saving_.leave_map_alone(true);
  localisation_ = finder_->figures();
  const StartLook& look = start_check_->looks().back();
  publisher_.publish(
      Message{fmt::format("the robot is not where the map was left: it was carried while it was off, or the map is not "
                          "of this place ({:.0f} "
                          "% of what it has seen in {:.1f} m contradicts the map). It looks where it is; the map stays "
                          "as it was until then",
                          100.0 * look.believed.contradicted_ratio, look.driven_m)});
  steps_.lose();
}

// From the tick on at which it is believed, all see the map and the robot's place in it.
void MissionLoop::find_itself() {
  finder_->update(world_.observation, world_.pose.T_map_robot, *world_.grid, world_.time_s);
  finder_->see_markers(world_.observation, world_.pose.T_map_robot, perception_.tracker().graph());
  localisation_ = finder_->figures();
  if (!finder_->T_map_local()) return;
  const Pose2 T_map_local = *finder_->T_map_local();
  const Pose2 T_map_robot = T_map_local * world_.pose.T_map_robot;
  localisation_->found_s = world_.time_s;
  localisation_->T_map_robot = T_map_robot;
  finder_.reset();
  const std::shared_ptr<Localizer> localizer = build_localizer(mission_, library_, {T_map_robot, kFoundUncertainty});
  if (options_.localise_in) {
    world_.T_map_start = T_map_local * world_.T_map_start;
    world_.grid = &perception_.settle(localizer);
    world_.coarse = nullptr;
  } else {
    world_.grid = &perception_.go_on(localizer, build_map(mission_, library_, &*grid_so_far_));
    world_.coarse = perception_.show_earlier_map();
    saving_.leave_map_alone(false);
  }
  world_.pose = perception_.localize(world_.observation);
  publisher_.publish(
      Message{fmt::format("found itself after {:.1f} m: at ({:.2f}, {:.2f}) m, {:.0f} degrees", localisation_->driven_m,
                          T_map_robot.x_m, T_map_robot.y_m, degrees(T_map_robot.theta_rad))});
}

}  // namespace cairn
