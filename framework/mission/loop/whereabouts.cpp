// How the mission knows where in its map the robot is: anywhere in a saved one, where it was left, or carried
// meanwhile.

#include <fmt/format.h>

#include <algorithm>

#include "framework/mission/loop/mission_loop.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

// Under way a check begins because something contradicts the map: a person, a door, a transducer that is stuck. So what
// contradicts the pose says less than at the start; mostly a place elsewhere must explain what is seen.
PoseCheckRules rules_under_way() {
  PoseCheckRules rules;
  rules.contradicted_ratio = 0.25;
  // A copy of the map that is some metres old does not hold what is being explored: there the true pose scores little,
  // and a room that looks alike scores more.
  rules.contradicted_ratio_beside = 0.12;
  rules.max_score = 0.5;
  rules.min_score = 0.6;
  return rules;
}

constexpr double kClear_ratio = 0.05;  // contradicted, at the end of a check

bool has_ranges(const RobotModel& robot) {
  return !robot.sonars.empty() || !robot.lasers.empty();
}

}  // namespace

void MissionLoop::begin_localisation(const LocaliseIn& localise) {
  localisation_.emplace();
  localisation_->is_pose_given = localise.T_map_start.has_value();
  perception_.leave_alone(*map_left_alone_, localise.map->graph, !localise.T_map_start);
  if (localise.T_map_start) return;
  world_.pose.trust = PoseTrust::lost;
  finder_.emplace(map_left_alone_, mission_.robot);
}

// A log knows no other place than its own, and a robot that measures nothing cannot be checked.
void MissionLoop::begin_watch() {
  if (!modules_.has_drive || !has_ranges(mission_.robot) || options_.localise_in) return;
  watch_.emplace(mission_.robot);
  if (modules_.find_myself) steps_.recover_by(modules_.find_myself, kFindMyself);
  if (options_.resume == nullptr || options_.T_map_resumed) return;
  const auto left = std::make_shared<const MapSnapshot>(
      MapSnapshot{*grid_so_far_, perception_.known_landmarks(), modules_.T_map_start});
  begin_check(left, modules_.T_map_start, std::nullopt);
}

void MissionLoop::begin_check(std::shared_ptr<const MapSnapshot> before, const Pose2& T_map_robot,
                              const std::optional<DoubtCause>& cause) {
  check_.emplace(OpenCheck{cause ? PoseCheck(rules_under_way()) : PoseCheck(), std::move(before), T_map_robot,
                           world_.time_s, cause});
  perception_.draw_own_map(
      build_localizer(mission_, library_, {T_map_robot, own_frame(mission_.robot)}, modules_.loop_closer_calls),
      build_map(mission_, library_, nullptr), *check_->before);
  finder_.emplace(std::shared_ptr<const OccupancyGrid>(check_->before, &check_->before->grid), mission_.robot);
  if (!cause) start_check_.emplace();
}

bool MissionLoop::is_check_open() const {
  return check_ && check_->check.is_open();
}

// Where a map was continued in the wrong place, the file that it came from is worth more.
bool MissionLoop::may_autosave() const {
  return !is_check_open() || (check_->cause && check_->check.verdict() == PoseVerdict::open);
}

// By what the ticks before have seen: the own map begins with this observation.
void MissionLoop::begin_check_in_doubt() {
  if (finder_ || !watch_ || !watch_->doubt()) return;
  begin_check(watch_->before(), world_.pose.T_map_robot, watch_->doubt());
}

// Copies of the map cost time and memory. A localizer that corrects its past bends the map that a copy would be of, and
// without the module that finds the robot nothing could be done about a doubt.
bool MissionLoop::is_watched() const {
  return watch_ && mission_.config.check_pose_under_way && modules_.find_myself && !perception_.has_history();
}

void MissionLoop::look_where_robot_is() {
  if (is_check_open())
    check_pose();
  else if (finder_)
    find_itself();
  else if (is_watched())
    watch_->update(world_.observation, world_.pose.T_map_robot, *world_.grid,
                   [this] { return perception_.known_landmarks(); });
}

// A search that is under way still ends in its thread: no tick waits for an answer that nobody needs.
void MissionLoop::end_search() {
  ending_searches_.add(finder_->let_go());
  finder_.reset();
}

// The own map begins where the robot is believed to be: as long as that is right, its frame is the map's.
void MissionLoop::check_pose() {
  PoseCheck& check = check_->check;
  const Pose2& T_local_robot = perception_.own_pose().T_map_robot;
  if (!finder_->is_compared()) finder_->compare_with(check_->T_map_begin, T_local_robot);
  finder_->update(world_.observation, T_local_robot, perception_.own_grid(), world_.time_s);
  finder_->see_markers(world_.observation, T_local_robot, perception_.tracker().graph());
  if (finder_->looks().size() > check.looks().size()) check.update(finder_->looks().back());
  if (!check_->cause) start_check_ = check;
  if (check.is_open()) return;
  if (check_->cause) watch_->record({check_->begun_s, *check_->cause, check});
  if (check.verdict() == PoseVerdict::carried) return lose_itself();
  perception_.drop_own_map();
  end_search();
  // A robot that was carried while it was checked has drawn two places into its own map.
  const bool is_clear = check.looks().back().believed.contradicted_ratio < kClear_ratio;
  check_.reset();
  if (is_clear)
    watch_->doubt_was_wrong();
  else
    watch_->keep_map();
}

// What was drawn and recognised since was in the wrong place.
void MissionLoop::lose_itself() {
  const std::size_t landmarks = world_.graph.landmarks().size();
  const PoseEstimate own_pose = perception_.own_pose();
  world_.lose(own_pose, perception_.lose(), check_->before->grid, check_->before->T_map_robot);
  if (!check_->cause) saving_.leave_map_alone(true);
  finder_->forget_markers();
  localisation_ = finder_->figures();
  if (check_->cause)
    watch_->record_carried({world_.time_s, counts_.figures().distance_m, check_->check.looks().back().driven_m});
  publish_carried(landmarks - std::min(landmarks, world_.graph.landmarks().size()));
  steps_.lose();
}

void MissionLoop::publish_carried(std::size_t landmarks_forgotten) {
  const PoseLook& look = check_->check.looks().back();
  const std::string why = fmt::format("({:.0f} % of what it has seen in {:.1f} m contradicts the map)",
                                      100.0 * look.believed.contradicted_ratio, look.driven_m);
  if (check_->cause)
    publisher_.publish(Message{
        fmt::format("the robot is not where it was believed to be: it was carried, or has slipped {}. It finds out "
                    "where it is; the map is as it was some metres before that, {} forgotten",
                    why, counted(landmarks_forgotten, "landmark"))});
  else
    publisher_.publish(Message{fmt::format(
        "the robot is not where the map was left: it was carried while it was off, or the map is not of this place {}. "
        "It finds out where it is; the map stays as it was until then",
        why)});
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
  end_search();
  const std::shared_ptr<Localizer> localizer = build_localizer(
      mission_, library_, {T_map_robot, kFoundUncertainty, submaps_so_far_.empty() ? nullptr : &submaps_so_far_},
      modules_.loop_closer_calls);
  if (options_.localise_in) {
    world_.T_map_start = T_map_local * world_.T_map_start;
    world_.exchange_map(perception_.settle(localizer), nullptr);
  } else {
    world_.exchange_map(perception_.go_on(localizer, build_map(mission_, library_, &check_->before->grid)), nullptr);
    world_.coarse = perception_.show_earlier_map();
    world_.map_before = nullptr;
    saving_.leave_map_alone(false);
    if (check_->cause) watch_->record_found(world_.time_s, localisation_->driven_m, T_map_robot);
    check_.reset();
    watch_->begin_anew();
  }
  world_.pose = perception_.localize(world_.observation);
  publisher_.publish(
      Message{fmt::format("found itself after {:.1f} m: at ({:.2f}, {:.2f}) m, {:.0f} degrees", localisation_->driven_m,
                          T_map_robot.x_m, T_map_robot.y_m, degrees(T_map_robot.theta_rad))});
}

}  // namespace cairn
